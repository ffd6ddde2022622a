#include "field_fusion/core/match/obstacle.h"

namespace field_fusion::core {
namespace {

double square(double x) { return x * x; }

Eigen::Matrix3d lidarCovariance(const Eigen::Vector3d& extent, const ObstacleParams& params) {
  const Eigen::Vector3d variances = extent.array().square() / 12.0 + square(params.lidar_range_sigma);
  return variances.asDiagonal();
}

Eigen::Matrix3d cameraCovariance(const CameraTarget& target, const ObstacleParams& params) {
  const double along = square(target.range_sigma);
  const double across = square(target.ray_range * std::tan(radians(params.bearing_sigma)));
  if (!(along > 0.0 && across > 0.0)) return Eigen::Matrix3d::Constant(kNaN);
  const Eigen::Matrix3d ray = target.direction * target.direction.transpose();
  return along * ray + across * (Eigen::Matrix3d::Identity() - ray);
}

double cameraExistence(const CameraTarget& target, const ObstacleParams& params) {
  return params.camera_existence * target.score;
}

}  // namespace

Obstacle lidarObstacle(const LidarTarget& body, const Verdict& verdict, const ObstacleParams& params) {
  const Cluster& cluster = body.cluster;
  Obstacle out;
  out.cluster = body.place;
  out.part = body.part;
  out.position = cluster.centre.cast<double>();
  out.joined = body.joined;
  out.size = cluster.box.sizes().cast<double>();
  out.face.setConstant(kNaN);
  out.covariance = lidarCovariance(out.size, params);
  out.existence = cluster.faint ? params.faint_existence : params.lidar_existence;
  out.polar = cluster.polar;
  out.verdict = verdict;
  return out;
}

Obstacle cameraObstacle(int camera, const CameraTarget& target, const Verdict& verdict,
                        const ObstacleParams& params) {
  Obstacle out;
  out.camera = camera;
  out.detection = target.id;
  out.source = ObstacleSource::kCamera;
  out.position = target.position;
  out.covariance = cameraCovariance(target, params);
  out.size.setConstant(kNaN);
  out.face.setConstant(kNaN);
  out.existence = cameraExistence(target, params);
  out.label = target.label;
  out.label_probability = target.score;
  out.polar = target.polar;
  out.verdict = verdict;
  return out;
}

Obstacle matchedObstacle(const LidarTarget& body, int camera, const CameraTarget& target,
                         const Verdict& verdict, const ObstacleParams& params) {
  Obstacle out = lidarObstacle(body, verdict, params);
  out.camera = camera;
  out.detection = target.id;
  out.source = ObstacleSource::kBoth;
  out.existence = 1.0 - (1.0 - out.existence) * (1.0 - cameraExistence(target, params));
  out.label = target.label;
  out.label_probability = target.score;
  return out;
}

void complete(Obstacle& obstacle, const Outline& outline) {
  obstacle.position = outline.centre;
  obstacle.covariance = outline.covariance;
  obstacle.size = outline.size;
  obstacle.face = outline.face;
  obstacle.polar = polar(outline.centre);
}

}  // namespace field_fusion::core
