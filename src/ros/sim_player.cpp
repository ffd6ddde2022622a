#include "field_fusion/ros/sim_player.h"

#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>

#include <chrono>

namespace field_fusion {

namespace {

constexpr double kTick = 0.01;  // s, between two messages on /clock
constexpr std::uint32_t kQueue = 10;
using Wall = std::chrono::steady_clock;

}  // namespace

SimPlayer::SimPlayer(ros::NodeHandle node, const SimNodeParams& params)
    : node_(std::move(node)), params_(params), run_(std::make_unique<SimRun>(params.sim)) {
  clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1);
  thread_ = std::thread([this] { play(); });
}

SimPlayer::~SimPlayer() {
  stop_ = true;
  thread_.join();
}

std::string SimPlayer::fault() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fault_;
}

void SimPlayer::play() try {
  do {
    if (!run_) run_ = std::make_unique<SimRun>(params_.sim);
    playOnce(*run_);
    run_.reset();
  } while (params_.loop && !stop_);
  if (stop_) return;
  finished_ = true;
  ROS_INFO("the simulation has ended: its %g s are over; what is latched stays until the node is ended", params_.seconds);
} catch (const std::exception& e) {
  ROS_ERROR("the simulation has ended: %s", e.what());
  const std::lock_guard<std::mutex> lock(mutex_);
  fault_ = e.what();
}

/// Where the machine is too slow, simulated time falls behind; it never hurries to catch up.
void SimPlayer::playOnce(SimRun& run) {
  const SimSink sink = [this](const SimOutput& output) { publish(output); };
  tellTime(0.0);
  run.begin(sink);
  const auto tick =
      std::chrono::duration_cast<Wall::duration>(std::chrono::duration<double>(kTick / params_.rate));
  auto next = Wall::now(), last_report = next;
  double last_time = 0.0;
  for (std::uint64_t i = 1; !stop_; ++i) {
    const double time = static_cast<double>(i) * kTick;
    if (params_.seconds > 0 && time > params_.seconds) return;
    tellTime(time);
    while (!stop_ && run.due() <= time) run.step(sink);
    next = std::max(next + tick, Wall::now());
    std::this_thread::sleep_until(next);
    if (const std::chrono::duration<double> past = next - last_report; past.count() > 1.0) {
      speed_ = (time - last_time) / past.count();
      last_time = time, last_report = next;
    }
  }
}

void SimPlayer::tellTime(double time) {
  time_ = time;
  rosgraph_msgs::Clock clock;
  clock.clock = simTime(time);
  clock_.publish(clock);
}

void SimPlayer::publish(const SimOutput& output) {
  std::visit(
      [&](const auto& message) {
        using Message = std::decay_t<decltype(*message)>;
        auto& publisher = publishers_[output.topic];
        if (!publisher)
          publisher = node_.advertise<std::remove_const_t<Message>>(output.topic, kQueue, output.latched);
        publisher.publish(message);
      },
      output.message);
}

}  // namespace field_fusion
