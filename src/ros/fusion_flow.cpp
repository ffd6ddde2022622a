#include "field_fusion/ros/fusion_flow.h"

#include <cmath>
#include <stdexcept>

#include "field_fusion/ros/grid_message.h"

namespace field_fusion {
namespace {

core::Silence silence(bool whole) { return whole ? core::Silence::kForgets : core::Silence::kKeeps; }

}  // namespace

void FusionFlow::setParams(const FusionStageParams& params) {
  fusion_.setParams(params.fusion);
  params_ = params;
}

void FusionFlow::reset() {
  fusion_.clear();
  header_ = {}, sent_ = {};
  maps_ = projected_ = 0;
}

core::Occupancy FusionFlow::checked(const nav_msgs::OccupancyGrid& map) const {
  const bool first = maps_ + projected_ == 0;
  if (!first && map.header.frame_id != header_.frame_id)
    throw std::runtime_error("frame differs: " + map.header.frame_id + ", not " + header_.frame_id);
  const auto& q = map.info.origin.orientation;
  if (!(std::abs(q.x) + std::abs(q.y) + std::abs(q.z) < 1e-6))
    throw std::runtime_error("map turned: its cells do not lie along x and y");
  return {std::round(map.info.resolution * 1e6) * 1e-6,
          map.info.origin.position.x,
          map.info.origin.position.y,
          static_cast<int>(map.info.width),
          static_cast<int>(map.info.height),
          map.data};
}

void FusionFlow::taken(const nav_msgs::OccupancyGrid& map, double& shift) {
  shift = fusion_.shift();
  header_.frame_id = map.header.frame_id;
  header_.stamp = std::max(header_.stamp, map.header.stamp);
}

void FusionFlow::addMap(const nav_msgs::OccupancyGrid& map) {
  fusion_.addA(checked(map), silence(params_.map_whole));
  ++maps_;
  taken(map, map_shift_);
}

void FusionFlow::addProjected(const nav_msgs::OccupancyGrid& map) {
  fusion_.addB(checked(map), silence(params_.projected_whole));
  ++projected_;
  taken(map, projected_shift_);
}

bool FusionFlow::isDue() {
  if (!sent_.isZero() && (header_.stamp - sent_).toSec() < params_.publish_interval) return false;
  sent_ = header_.stamp;
  return true;
}

boost::shared_ptr<nav_msgs::OccupancyGrid> FusionFlow::fused() const {
  return gridMessage(header_, fusion_.map());
}

boost::shared_ptr<nav_msgs::OccupancyGrid> FusionFlow::local(const TfCache& tf) {
  lost_ = !tf.has(header_.frame_id, params_.base_frame, header_.stamp);
  if (lost_) return nullptr;
  const Eigen::Vector3d at = tf.lookup(header_.frame_id, params_.base_frame, header_.stamp).translation();
  return gridMessage(header_, fusion_.about(at.x(), at.y(), params_.local_size));
}

void FusionFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (maps_ == 0 && projected_ > 0) status.mergeSummary(DiagnosticStatus::WARN, "no map A yet");
  if (projected_ == 0 && maps_ > 0) status.mergeSummary(DiagnosticStatus::WARN, "no map B yet");
  if (lost_)
    status.mergeSummary(DiagnosticStatus::WARN,
                        "TF does not know " + params_.base_frame + " in " + header_.frame_id);
  status.add("maps A", maps_);
  status.add("maps B", projected_);
  status.add("map A: moved to the nearest cell by [cells]", map_shift_);
  status.add("map B: moved to the nearest cell by [cells]", projected_shift_);
  status.add("fused map: columns", fusion_.map().width);
  status.add("fused map: rows", fusion_.map().height);
}

}  // namespace field_fusion
