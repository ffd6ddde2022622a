#include "field_fusion/ros/convert.h"

#include <boost/make_shared.hpp>

namespace field_fusion {
namespace {

template <class Xyz, class Vector>
Xyz xyz(const Vector& v) {
  Xyz out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

template <class Xyz>
Eigen::Vector3d vectorOf(const Xyz& p) {
  return {p.x, p.y, p.z};
}

Cluster toMessage(const core::Cluster& in, std::uint32_t id) {
  Cluster out;
  out.id = id;
  out.faint = in.faint;
  out.first_point = in.points.first;
  out.point_count = in.points.count;
  out.min = xyz<geometry_msgs::Point>(in.box.min());
  out.max = xyz<geometry_msgs::Point>(in.box.max());
  out.centre = xyz<geometry_msgs::Point>(in.centre);
  out.range = static_cast<float>(in.polar.range);
  out.azimuth = static_cast<float>(in.polar.azimuth);
  out.elevation = static_cast<float>(in.polar.elevation);
  out.nearest_range = in.nearest_range;
  out.box_centre = xyz<geometry_msgs::Point>(in.oriented_box.centre);
  out.box_size = xyz<geometry_msgs::Vector3>(in.oriented_box.size);
  out.box_yaw = in.oriented_box.yaw;
  return out;
}

core::Cluster fromMessage(const Cluster& in) {
  core::Cluster out;
  out.faint = in.faint;
  out.points = {in.first_point, in.point_count};
  out.box = {vectorOf(in.min).cast<float>(), vectorOf(in.max).cast<float>()};
  out.centre = vectorOf(in.centre).cast<float>();
  out.polar = {in.range, in.azimuth, in.elevation};
  out.nearest_range = in.nearest_range;
  out.oriented_box.centre = vectorOf(in.box_centre).cast<float>();
  out.oriented_box.size = vectorOf(in.box_size).cast<float>();
  out.oriented_box.yaw = in.box_yaw;
  return out;
}

Obstacle toMessage(const core::Obstacle& in, std::uint32_t id) {
  Obstacle out;
  out.id = id;
  out.cluster_id = in.cluster;
  out.joined_clusters.assign(in.joined.begin(), in.joined.end());
  out.part = static_cast<std::uint8_t>(in.part);
  out.camera = in.camera;
  out.detection_id = in.detection;
  out.source = static_cast<std::uint8_t>(in.source);
  out.position = xyz<geometry_msgs::Point>(in.position);
  Eigen::Map<Eigen::Matrix3d>(out.position_covariance.data()) = in.covariance;  // symmetric: either order
  out.size = xyz<geometry_msgs::Vector3>(in.size);
  out.face = xyz<geometry_msgs::Point>(in.face);
  out.existence = static_cast<float>(in.existence);
  out.label = in.label;
  out.label_probability = static_cast<float>(in.label_probability);
  out.range = static_cast<float>(in.polar.range);
  out.azimuth = static_cast<float>(in.polar.azimuth);
  out.elevation = static_cast<float>(in.polar.elevation);
  out.reason = static_cast<std::uint8_t>(in.verdict.reason);
  out.range_difference = static_cast<float>(in.verdict.range_difference);
  out.azimuth_difference = static_cast<float>(in.verdict.azimuth_difference);
  out.distance = static_cast<float>(in.verdict.distance);
  return out;
}

core::CameraTarget fromMessage(const ImageDetection& in) {
  core::CameraTarget out;
  out.id = static_cast<int>(in.id);
  out.label = in.label;
  out.score = in.score;
  out.ray_range = in.range;
  out.range_sigma = in.range_sigma;
  out.cut = in.cut;
  return out;
}

}  // namespace

boost::shared_ptr<ClusterArray> clusterMessage(const std_msgs::Header& header,
                                               const core::Clusters& clusters) {
  auto out = boost::make_shared<ClusterArray>();
  out->header = header;
  out->clusters.reserve(clusters.clusters.size());
  for (const auto& cluster : clusters.clusters)
    out->clusters.push_back(toMessage(cluster, static_cast<std::uint32_t>(out->clusters.size())));
  out->points.reserve(clusters.points.size());
  for (const auto& point : clusters.points)
    out->points.push_back(xyz<geometry_msgs::Point32>(point.position()));
  return out;
}

std::vector<core::Cluster> clustersOf(const ClusterArray& message) {
  std::vector<core::Cluster> out;
  out.reserve(message.clusters.size());
  for (const auto& cluster : message.clusters) out.push_back(fromMessage(cluster));
  return out;
}

std::vector<core::Point> pointsOf(const ClusterArray& message) {
  std::vector<core::Point> out(message.points.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& point = message.points[i];
    out[i].x = point.x, out[i].y = point.y, out[i].z = point.z;
  }
  return out;
}

core::CameraView cameraViewOf(const ImageDetectionArray& message, const core::Transform* T_lidar_camera) {
  core::CameraView out;
  if (T_lidar_camera) out.T_view_lidar = core::viewFromOptical() * T_lidar_camera->inverse();
  for (const auto& detection : message.detections) {
    auto& target = out.targets.emplace_back(fromMessage(detection));
    if (!T_lidar_camera) continue;
    const auto ray = vectorOf(detection.ray);
    core::look(target, ray, vectorOf(detection.ray_min), vectorOf(detection.ray_max));
    core::carryToLidar(target, ray, *T_lidar_camera);
  }
  return out;
}

boost::shared_ptr<ObstacleArray> obstacleMessage(const std_msgs::Header& header, std::uint8_t revision,
                                                 bool provisional,
                                                 const std::vector<core::Obstacle>& obstacles) {
  auto out = boost::make_shared<ObstacleArray>();
  out->header = header;
  out->revision = revision;
  out->provisional = provisional;
  out->obstacles.reserve(obstacles.size());
  for (const auto& obstacle : obstacles)
    out->obstacles.push_back(toMessage(obstacle, static_cast<std::uint32_t>(out->obstacles.size())));
  return out;
}

}  // namespace field_fusion
