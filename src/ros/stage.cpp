#include "field_fusion/ros/stage.h"

#include <image_transport/image_transport.h>

#include <algorithm>
#include <cmath>

#include "field_fusion/ros/params_io.h"

namespace field_fusion {
namespace {

constexpr double kHoldPoll = 0.005;  // [s] of wall time
const ros::WallDuration kDiagnosticsPeriod(1.0);

/// What `~image_transport` names. Throws std::runtime_error where no such transport is installed: found now,
/// not when somebody listens.
image_transport::TransportHints imageTransport(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh) {
  const image_transport::TransportHints hints("raw", ros::TransportHints(), private_nh);
  const std::string prefix = "image_transport/";
  auto known = image_transport::ImageTransport(nh).getDeclaredTransports();
  if (std::find(known.begin(), known.end(), prefix + hints.getTransport()) != known.end()) return hints;
  std::string text = "image_transport: " + hints.getTransport() + " is not installed; there are:";
  for (const auto& name : known) text += " " + name.substr(name.rfind('/') + 1);
  throw std::runtime_error(text);
}

/// Messages between two numbers of one publisher; 0 where they cannot be of one run of it.
std::uint32_t gapBefore(std::uint32_t seq, std::uint32_t last) {
  constexpr std::uint32_t kLargestGap = 1000;
  const std::uint32_t gap = seq - last - 1;
  return last == 0 || seq <= last || gap > kLargestGap ? 0 : gap;
}

}  // namespace

void Stage::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  // not under the mutex: each of these waits for its callback, which may be waiting for the mutex
  for (auto& timer : timers_) timer.stop();
  reconfigure_.reset();
  for (auto& service : services_) service.shutdown();
  for (auto& port : outputs_) port.publisher.shutdown();
  for (auto& port : inputs_) port.subscription.reset();
}

void Stage::onInit() try {
  const std::lock_guard<std::mutex> lock(mutex_);  // callbacks may come before onInit has ended
  start();
} catch (const std::exception& e) {
  NODELET_FATAL_STREAM("not started: " << e.what());  // the loader itself tells nobody
  announceRefusal(e.what());
  stop();  // now: the loader takes the callback queues away before it destroys the stage
  throw;
}

void Stage::start() {
  declare(declared_);
  stage_params_.declare(declared_);
  for (const auto& name : loadParams(getPrivateNodeHandle(), declared_, others()))
    NODELET_WARN_STREAM(name << " has no counterpart in this stage: it is ignored");
  tf_ = TfCache::shared();  // listens from now on, so that the first message finds its transform
  onStart();
  reconfigure_ =
      std::make_unique<Reconfigure>(getPrivateNodeHandle(), declared_, mutex_, [this] { onParams(); });
  updater_ =
      std::make_unique<diagnostic_updater::Updater>(getNodeHandle(), getPrivateNodeHandle(), getName());
  updater_->setHardwareID("none");
  updater_->add("stage", this, &Stage::diagnose);
  // the updater's own clock stands still when the time of a bag jumps back
  timers_.push_back(getNodeHandle().createWallTimer(
      kDiagnosticsPeriod, [this](const ros::WallTimerEvent&) { updater_->force_update(); }));
  hold_timer_ = every(kHoldPoll, [this] { release(); });
  hold_timer_.stop();
  updateSubscriptions();
}

InputPort& Stage::addInput(const std::string& topic) {
  auto& port = inputs_.emplace_back();
  port.topic = topic;
  return port;
}

InputPort& Stage::imageInput(const std::string& topic, Handler<sensor_msgs::Image> handler,
                             Ready<sensor_msgs::Image> ready) {
  auto& port = addInput(topic);
  auto receive = receiver<sensor_msgs::Image>(port, std::move(handler), std::move(ready));
  const auto hints = imageTransport(getNodeHandle(), getPrivateNodeHandle());
  port.subscribe = [this, topic, receive, hints]() -> std::shared_ptr<void> {
    image_transport::ImageTransport transport(getNodeHandle());
    return std::make_shared<image_transport::Subscriber>(
        transport.subscribe(topic, kQueue, receive, ros::VoidPtr(), hints));
  };
  return port;
}

ros::WallTimer Stage::every(double seconds, std::function<void()> work) {
  const auto turn = [this, work](const ros::WallTimerEvent&) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!stopped_) try {
        work();
      } catch (const std::exception& e) {
        NODELET_ERROR_STREAM_THROTTLE(5.0, "periodic work failed: " << e.what());
      }
  };
  timers_.push_back(getNodeHandle().createWallTimer(ros::WallDuration(seconds), turn));
  return timers_.back();
}

void Stage::onSubscribersChanged(bool wants_latched) try {
  const std::lock_guard<std::mutex> lock(mutex_);
  updateSubscriptions();
  if (wants_latched && !stopped_) onListener();
} catch (const std::exception& e) {  // an image transport whose library is missing
  NODELET_FATAL_STREAM("cannot subscribe: " << e.what());
}

std::shared_ptr<void> Stage::link(const InputPort& port) {
  const std::lock_guard<std::mutex> linking(linkMutex());
  return port.subscribe();
}

void Stage::updateSubscriptions() {
  if (stopped_) return;
  bool wanted = listen_ == Listen::kAlways || outputs_.empty();
  for (const auto& port : outputs_) wanted |= port.publisher.getNumSubscribers() > 0;
  if (wanted == subscribed_) return;
  subscribed_ = wanted;
  for (auto& port : inputs_) {
    port.subscription = wanted ? link(port) : nullptr;
    port.order.reset(), port.ahead.reset();
    port.last_seq = 0;
    port.last_arrival = ros::WallTime::now();
  }
  if (!wanted) held_.clear();
}

void Stage::onArrival(InputPort& port, Arrival arrival, const std::string& damage) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto stamp = arrival.message.stamp;
  ++port.received;
  port.missing += gapBefore(arrival.seq, port.last_seq);
  port.last_seq = arrival.seq;
  port.last_arrival = arrival.at;
  port.last = arrival.message;
  if (!damage.empty()) return fault(port, stamp, damage);
  if (!inOrder(port, arrival)) return;
  if (!waits(port) && isReady(arrival)) {
    handle(port, arrival);
    return release();  // what waits on another input may have waited for this
  }
  if (held_.size() == kMaxHeld) {
    fault(*held_.front().port, held_.front().arrival.message.stamp,
          "too many messages wait: the oldest is dropped");
    held_.pop_front();
  }
  held_.push_back({&port, std::move(arrival)});
  hold_timer_.start();
}

bool Stage::waits(const InputPort& port) const {
  return std::any_of(held_.begin(), held_.end(), [&](const Held& held) { return held.port == &port; });
}

/// Where that cannot even be asked, the handler will say why.
bool Stage::isReady(const Arrival& arrival) try {
  return !arrival.ready || arrival.ready();
} catch (const std::exception&) {
  return true;
}

void Stage::release() {
  const auto now = ros::WallTime::now();
  std::deque<Held> still;  // an input's messages keep their order: behind one that waits, all wait
  held_.swap(still);
  for (auto& held : still) {
    const bool expired = (now - held.arrival.at).toSec() >= stage_params_.hold_limit;
    if (!waits(*held.port) && (expired || isReady(held.arrival)))
      handle(*held.port, held.arrival);
    else
      held_.push_back(std::move(held));
  }
  if (held_.empty()) hold_timer_.stop();
}

bool Stage::inOrder(InputPort& port, const Arrival& arrival) {
  const ros::Time& stamp = arrival.message.stamp;
  if (stamp.isZero()) {
    fault(port, stamp, "stamp is zero");
    return false;
  }
  const auto nanoseconds = [](const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); };
  if (const double ahead = port.ahead.check(nanoseconds(stamp), nanoseconds(ros::Time::now())); ahead > 0.0) {
    fault(port, stamp, "stamp is ahead of the clock: by " + std::to_string(std::lround(ahead)) + " s");
    return false;
  }
  switch (port.order.check(nanoseconds(stamp), arrival.revision)) {
    case core::StampOrder::Verdict::kTimeJump:
      jump(port, port.believed, stamp);
      [[fallthrough]];
    case core::StampOrder::Verdict::kNewer:
      port.believed = stamp;
      return true;
    case core::StampOrder::Verdict::kOutOfOrder:
      fault(port, stamp, "stamp out of order: not newer than the last");
      return false;
  }
  return false;
}

void Stage::jump(InputPort& port, const ros::Time& before, const ros::Time& stamp) {
  ++time_jumps_;
  NODELET_WARN_STREAM("time jumped back from " << before << " to " << stamp << " on " << port.topic << ": state is cleared");
  for (auto& other : inputs_)
    if (&other != &port) other.order.reset();  // they follow, and the state is cleared only once
  held_.clear();
  tf_->onTimeJump();
  attempt(port, stamp, [this] { onTimeJump(); });
}

void Stage::handle(InputPort& port, const Arrival& arrival) {
  if (attempt(port, arrival.message.stamp, arrival.handle) && !port.deferred) count(port, arrival.at);
}

bool Stage::attempt(InputPort& port, const ros::Time& stamp, const std::function<void()>& work) try {
  work();
  return true;
} catch (const std::exception& e) {
  fault(port, stamp, e.what());
  return false;
}

bool Stage::serve(const std::string& name, const std::function<void()>& work) try {
  if (!stopped_) work();
  return !stopped_;
} catch (const std::exception& e) {
  NODELET_ERROR_STREAM(name << ": " << e.what());
  return false;
}

void Stage::count(InputPort& port, ros::WallTime arrival) {
  ++port.processed;
  port.latency.add((ros::WallTime::now() - arrival).toSec());
}

void Stage::fault(InputPort& port, const ros::Time& stamp, const std::string& text) {
  if (port.faults.add(text)) NODELET_ERROR_STREAM(port.topic << ", stamp " << stamp << ": " << text);
}

}  // namespace field_fusion
