// What a stage tells on /diagnostics.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <diagnostic_msgs/DiagnosticStatus.h>

#include <sstream>

#include "field_fusion/ros/stage.h"

namespace field_fusion {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

constexpr double kFaultShown = 5.0;  // [s] of wall time that a fault keeps the status at WARN

std::string traceText(const MessageTrace& trace) {
  std::ostringstream out;
  out << trace.stamp << " at " << trace.address;
  return out.str();
}

void describe(const InputPort& port, DiagnosticStatusWrapper& status) {
  const auto key = [&](const char* what) { return port.topic + ": " + what; };
  const auto milliseconds = [](double seconds) { return 1e3 * seconds; };
  status.add(key("received"), port.received);
  status.add(key("processed"), port.processed);
  status.add(key("skipped"), port.skipped);
  status.add(key("missing"), port.missing);
  status.add(key("dropped"), port.faults.total());
  for (const auto& [kind, count] : port.faults.byKind()) status.add(key("dropped, ") + kind, count);
  if (port.latency.count() > 0) {
    status.addf(key("latency p50 p95 p99 max [ms]"), "%.3f %.3f %.3f %.3f",
                milliseconds(port.latency.percentile(0.50)), milliseconds(port.latency.percentile(0.95)),
                milliseconds(port.latency.percentile(0.99)), milliseconds(port.latency.max()));
  }
  status.add(key("last message"), traceText(port.last));
}

/// What was lately wrong with an input's messages; empty when nothing was.
std::string faultText(const InputPort& port) {
  return port.faults.age() < kFaultShown ? port.topic + " dropped, " + port.faults.last() : "";
}

/// For how long an input has been silent; empty while it is not. A fault shortly before does not hide it.
std::string silenceText(const InputPort& port, double timeout) {
  if (port.last_arrival.isZero()) return "waiting for " + port.topic;
  const double silent = (ros::WallTime::now() - port.last_arrival).toSec();
  if (port.optional || silent < timeout) return "";
  std::ostringstream out;
  out.precision(2);
  out << (port.received == 0 ? "waiting for " : "nothing new on ") << port.topic << " for " << std::fixed
      << silent << " s";
  return out.str();
}

}  // namespace

void Stage::diagnose(DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(DiagnosticStatus::OK, subscribed_ ? "running" : "IDLE: nobody listens");
  for (const auto& port : inputs_) {
    for (const auto& worry : {faultText(port), silenceText(port, stage_params_.input_timeout)})
      if (subscribed_ && !worry.empty()) status.mergeSummary(DiagnosticStatus::WARN, worry);
    describe(port, status);
  }
  for (const auto& port : outputs_) {
    status.add(port.publisher.getTopic() + ": published", port.published);
    status.add(port.publisher.getTopic() + ": last message", traceText(port.last));
  }
  status.add("time jumps", time_jumps_);
  onDiagnostics(status);
}

void Stage::announceRefusal(const std::string& reason) {
  // latched and never taken down: the stage goes, the manager and this word stay
  static auto* const publisher = new ros::Publisher(
      ros::NodeHandle().advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 20, true));
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.resize(1);
  array.status[0].name = getName().substr(1) + ": stage";
  array.status[0].level = DiagnosticStatus::ERROR;
  array.status[0].message = "not started: " + reason;
  publisher->publish(array);
}

}  // namespace field_fusion
