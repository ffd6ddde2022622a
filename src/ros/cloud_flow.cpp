#include "field_fusion/ros/cloud_flow.h"

#include <boost/make_shared.hpp>

#include <stdexcept>

namespace field_fusion {

void CloudFlow::setParams(const DeskewCloudParams& params) {
  motion_.setParams(params.motion);
  params_ = params;
}

void CloudFlow::reset() {
  motion_.reset();
  stamp_ = {};
}

void CloudFlow::take(const CloudMessage& message) {
  if (message.header.stamp == stamp_) return;  // asked again, whether it is ready
  sweep_ = core::sweepOf(message.points);
  stamp_ = message.header.stamp;
}

bool CloudFlow::ready(const CloudMessage& message, const TfCache& tf) {
  take(message);
  return !sweep_.known || motion_.ready(message.header, sweep_.sweep, tf);
}

CloudFlow::Output CloudFlow::run(const CloudMessage::ConstPtr& message, const TfCache& tf) {
  take(*message);
  const auto why =
      sweep_.known ? motion_.follow(message->header, sweep_.sweep, tf, track_) : "its points have no times";
  Output out{message};
  if (!why.empty()) {
    if (params_.motion.fallback == MotionParams::Fallback::kDrop) throw std::runtime_error(why);
    out.log = raw_.add(why);
    return out;
  }
  const auto points = boost::make_shared<CloudMessage>();
  points->header = message->header;
  points->header.stamp += ros::Duration(sweep_.sweep.at(params_.motion.instant));
  core::deskew(message->points, track_, points->points);
  out.points = points;
  return out;
}

void CloudFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  describeRaw(raw_, "clouds", status);
  status.add("last cloud: duration [ms]", 1e3 * (sweep_.sweep.end - sweep_.sweep.begin));
  status.add("last cloud: points without time", sweep_.untimed);
}

}  // namespace field_fusion
