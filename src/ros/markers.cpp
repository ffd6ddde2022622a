#include "field_fusion/ros/markers.h"

#include <algorithm>
#include <boost/make_shared.hpp>

#include "field_fusion/core/base/types.h"

namespace field_fusion {
namespace {

constexpr double kDash = 0.25;  // [m]

Eigen::Vector3d positionOf(const Obstacle& o) { return {o.position.x, o.position.y, o.position.z}; }
Eigen::Vector3d sizeOf(const Obstacle& o) { return {o.size.x, o.size.y, o.size.z}; }

/// Where the camera has it: the LiDAR's place less the differences. They have no elevation: the LiDAR's
/// serves.
Eigen::Vector3d cameraPositionOf(const Obstacle& o) {
  if (o.source == Obstacle::SOURCE_CAMERA) return positionOf(o);
  return core::cartesian({o.range - o.range_difference, o.azimuth - o.azimuth_difference, o.elevation});
}

/// Middle of the far upper edge: what stands there is not before the body for those who look from the sensor.
Eigen::Vector3d topOf(const Obstacle& o) {
  const double depth = std::abs(std::cos(o.azimuth)) * o.size.x + std::abs(std::sin(o.azimuth)) * o.size.y;
  return positionOf(o) +
         0.5 * Eigen::Vector3d(std::cos(o.azimuth) * depth, std::sin(o.azimuth) * depth, o.size.z);
}

}  // namespace

boost::shared_ptr<visualization_msgs::MarkerArray> ObstacleMarkers::draw(const ObstacleArray& obstacles) {
  clear();
  for (const auto& obstacle : obstacles.obstacles) {
    if (obstacle.source != Obstacle::SOURCE_CAMERA) addLidar(obstacle);
    if (obstacle.source != Obstacle::SOURCE_LIDAR) addCamera(obstacle);
  }
  labelNearest(obstacles.obstacles);
  layOut(labels_);

  auto out = boost::make_shared<visualization_msgs::MarkerArray>();
  for (const auto& [layer, points] : points_) {
    if (points.empty()) continue;
    const bool spheres = styleOf(layer).type == Marker::SPHERE_LIST;
    out->markers.push_back(
        marker(obstacles.header, layer, 0, spheres ? params_.sphere_size : params_.line_width));
    out->markers.back().points = points;
  }
  std::map<Layer, int> count;
  for (const Label& label : labels_) {
    out->markers.push_back(marker(obstacles.header, label.layer, count[label.layer]++, label.letter));
    out->markers.back().text = label.text;
    out->markers.back().pose.position = pointOf(label.place);
  }
  removeVanished(obstacles.header, *out);
  return out;
}

void ObstacleMarkers::clear() {
  for (auto& [layer, points] : points_) points.clear();
  labels_.clear();
}

void ObstacleMarkers::addLidar(const Obstacle& obstacle) {
  const bool alone = obstacle.source == Obstacle::SOURCE_LIDAR;
  points_[alone ? Layer::kLidarAlone : Layer::kLidar].push_back(obstacle.position);
  addBox(points_[alone ? Layer::kBoxAlone : Layer::kBox], positionOf(obstacle), sizeOf(obstacle));
  if (!alone) addLabel(obstacle, Layer::kLabel, topOf(obstacle));
}

void ObstacleMarkers::addCamera(const Obstacle& obstacle) {
  const bool alone = obstacle.source == Obstacle::SOURCE_CAMERA;
  const Eigen::Vector3d place = cameraPositionOf(obstacle);
  if (place.allFinite()) {
    points_[Layer::kCamera].push_back(pointOf(place));
    addDashedCircle(points_[Layer::kTolerance], place, params_.dist_tolerance);
    if (!alone) addDashedLine(points_[Layer::kPair], place, positionOf(obstacle), kDash);
    if (alone)
      addLabel(obstacle, Layer::kLabelCamera, place + Eigen::Vector3d(0, 0, 0.5 * params_.sphere_size));
  } else if (std::isfinite(obstacle.azimuth + obstacle.elevation)) {
    const Eigen::Vector3d end =
        core::cartesian({params_.bearing_length, obstacle.azimuth, obstacle.elevation});
    addDashedLine(points_[Layer::kBearing], Eigen::Vector3d::Zero(), end, 2 * kDash);
    addLabel(obstacle, Layer::kLabelCamera, end);
  }
}

void ObstacleMarkers::addLabel(const Obstacle& obstacle, Layer layer, const Eigen::Vector3d& top) {
  const double grown = std::max(1.0, top.norm() / 15.0);
  labels_.push_back({labelText(obstacle), layer, params_.letter_size * styleOf(layer).size * grown, top});
}

void ObstacleMarkers::labelNearest(const std::vector<Obstacle>& obstacles) {
  std::vector<const Obstacle*> near;
  for (const auto& o : obstacles)
    if (o.source == Obstacle::SOURCE_LIDAR && o.range <= params_.label_range) near.push_back(&o);
  const auto count = std::min(near.size(), static_cast<std::size_t>(params_.label_count));
  std::partial_sort(near.begin(), near.begin() + count, near.end(),
                    [](const Obstacle* a, const Obstacle* b) { return a->range < b->range; });
  for (std::size_t i = 0; i < count; ++i) addLabel(*near[i], Layer::kLabelAlone, topOf(*near[i]));
}

visualization_msgs::Marker ObstacleMarkers::marker(const std_msgs::Header& header, Layer layer, int id,
                                                   double size) const {
  const auto& style = styleOf(layer);
  Marker out;
  out.header = header;
  out.ns = style.name;
  out.id = id;
  out.type = style.type;
  out.action = Marker::ADD;
  out.pose.orientation.w = 1.0;
  const bool text = style.type == Marker::TEXT_VIEW_FACING;
  out.scale.x = out.scale.y = out.scale.z = text ? size : size * style.size;
  out.color.r = style.red;
  out.color.g = style.green;
  out.color.b = style.blue;
  out.color.a = style.alpha;
  return out;
}

void ObstacleMarkers::removeVanished(const std_msgs::Header& header, visualization_msgs::MarkerArray& out) {
  std::vector<std::pair<std::string, int>> now;
  for (const auto& marker : out.markers) now.emplace_back(marker.ns, marker.id);
  std::sort(now.begin(), now.end());
  for (const auto& [ns, id] : shown_) {
    if (std::binary_search(now.begin(), now.end(), std::make_pair(ns, id))) continue;
    Marker gone;
    gone.header = header;  // RViz drops what has no frame, and the mark would stay
    gone.ns = ns;
    gone.id = id;
    gone.action = Marker::DELETE;
    out.markers.push_back(gone);
  }
  shown_ = std::move(now);
}

}  // namespace field_fusion
