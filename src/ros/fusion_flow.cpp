#include "field_fusion/ros/fusion_flow.h"

#include <cmath>
#include <stdexcept>

#include "field_fusion/core/io/map_file.h"
#include "field_fusion/ros/grid_message.h"
#include "field_fusion/ros/save_map.h"

namespace field_fusion {
namespace {

core::Silence silence(bool whole) { return whole ? core::Silence::kForgets : core::Silence::kKeeps; }

/// [m] The message has 32 bits of it.
double resolutionOf(const nav_msgs::OccupancyGrid& map) { return std::round(map.info.resolution * 1e6) / 1e6; }

/// Of a mapper that has seen nothing yet.
bool isEmpty(const nav_msgs::OccupancyGrid& map) {
  return map.data.empty() && (map.info.width == 0 || map.info.height == 0);
}

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

bool FusionFlow::fits(const nav_msgs::OccupancyGrid& map) const {
  return map.header.frame_id == header_.frame_id && resolutionOf(map) == fusion_.map().resolution;
}

core::Occupancy FusionFlow::checked(const nav_msgs::OccupancyGrid& map) const {
  if (map.header.frame_id.empty()) throw std::runtime_error("frame missing: frame_id is empty");
  if (hasMap() && map.header.frame_id != header_.frame_id)
    throw std::runtime_error("frame differs: " + map.header.frame_id + ", not " + header_.frame_id);
  const auto& q = map.info.origin.orientation;
  if (!(std::abs(q.x) + std::abs(q.y) + std::abs(q.z) < 1e-6))
    throw std::runtime_error("map turned: its cells do not lie along x and y");
  return {resolutionOf(map),
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
  if (isEmpty(map)) return;
  if (maps_ == 0 && projected_ > 0 && !map.header.frame_id.empty() && !fits(map)) reset();
  fusion_.addA(checked(map), silence(params_.map_whole));
  ++maps_;
  taken(map, map_shift_);
}

void FusionFlow::addProjected(const nav_msgs::OccupancyGrid& map) {
  if (isEmpty(map)) return;
  fusion_.addB(checked(map), silence(params_.projected_whole));
  ++projected_;
  taken(map, projected_shift_);
}

bool FusionFlow::isDue() {
  if (!hasMap()) return false;
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

void FusionFlow::save(const SaveMap::Request& request, SaveMap::Response& answer) const {
  saveMap(request, answer, [this](const std::string& file) {
    if (!hasMap()) throw std::runtime_error("there is no map yet");
    core::writeMap(file, fusion_.map());
  });
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
