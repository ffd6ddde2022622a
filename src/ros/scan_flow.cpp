#include "field_fusion/ros/scan_flow.h"

#include <boost/make_shared.hpp>

#include "field_fusion/ros/scan_message.h"

namespace field_fusion {
namespace {

/// Raw scans are told from others by their time_increment; of a driver that sends none, by that which is known otherwise.
sensor_msgs::LaserScan::ConstPtr marked(const sensor_msgs::LaserScan& raw, double time_increment) {
  const auto out = boost::make_shared<sensor_msgs::LaserScan>(raw);
  out->time_increment = static_cast<float>(time_increment);
  return out;
}

}  // namespace

void ScanFlow::setParams(const DeskewScanParams& params) {
  motion_.setParams(params.motion);
  vicp_.setParams(params.vicp);
  params_ = params;
}

void ScanFlow::reset() {
  motion_.reset();
  vicp_.reset();
  clock_.reset();
  stamp_ = {};
}

void ScanFlow::take(const sensor_msgs::LaserScan& message) {
  if (message.header.stamp == stamp_) return;  // asked again, whether it is ready
  scan_ = scanOf(message);
  stamp_ = message.header.stamp;
  timing_ = clock_.of(scan_, stamp_.toSec(), params_.sweep_time);
  const double beams = scan_.ranges.empty() ? 0.0 : static_cast<double>(scan_.ranges.size() - 1);
  sweep_ = {params_.stamp_offset, params_.stamp_offset + beams * timing_.time_increment};
}

bool ScanFlow::ready(const sensor_msgs::LaserScan& message, const TfCache& tf) try {
  if (params_.method == DeskewScanParams::Method::kVicp) return true;
  take(message);
  return motion_.ready(message.header, sweep_, tf);
} catch (const std::runtime_error&) {
  return true;  // run tells what is wrong
}

std::string ScanFlow::follow(const std_msgs::Header& header, const TfCache& tf) {
  if (params_.method != DeskewScanParams::Method::kVicp) return motion_.follow(header, sweep_, tf, track_);
  core::scanPoints(scan_, sweep_.begin, timing_.time_increment, raw_points_);
  const auto velocity = vicp_.run(raw_points_, header.stamp.toSec());
  if (!velocity) return "it lies on no scan before";
  track_.keepOn({velocity->x, velocity->y, 0.0}, {0.0, 0.0, velocity->turn}, sweep_,
                sweep_.at(params_.motion.instant));
  return "";
}

ScanFlow::Output ScanFlow::run(const sensor_msgs::LaserScan::ConstPtr& message, const TfCache& tf) {
  take(*message);
  const auto points = boost::make_shared<CloudMessage>();
  points->header = message->header;
  Output out{message, points};
  const auto why = follow(message->header, tf);
  if (!why.empty()) {
    if (params_.motion.fallback == MotionParams::Fallback::kDrop) throw std::runtime_error(why);
    out.log = raw_.add(why);
    core::scanPoints(scan_, sweep_.begin, timing_.time_increment, points->points);
    if (message->time_increment == 0.f && timing_.time_increment != 0.0) out.scan = marked(*message, timing_.time_increment);
    return out;
  }
  scan_.scan_time = timing_.scan_time;
  counts_ = deskewer_.run(scan_, sweep_.begin, timing_.time_increment, track_, binned_, points->points);
  points->header.stamp += ros::Duration(sweep_.at(params_.motion.instant));
  out.scan = scanMessage(points->header, binned_);
  return out;
}

void ScanFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  describeRaw(raw_, "scans", status);
  using diagnostic_msgs::DiagnosticStatus;
  const auto warn = [&](const std::string& text) { status.mergeSummary(DiagnosticStatus::WARN, text); };
  using Basis = core::SweepTiming::Basis;
  if (timing_.basis == Basis::kInstant || timing_.basis == Basis::kSpacing)
    warn(core::describe(timing_.basis));
  if (timing_.scan_time_is_wrong) warn("scan_time is wrong: the time between scans is taken instead");
  status.add("beam times by", core::describe(timing_.basis));
  status.add("last scan: duration [ms]", 1e3 * (sweep_.end - sweep_.begin));
  status.add("last scan: returns", counts_.returns);
  status.add("last scan: bins that no beam fell into", counts_.unseen);
  if (params_.method == DeskewScanParams::Method::kVicp)
    status.add("vicp: updates of the velocity", vicp_.updates());
}

}  // namespace field_fusion
