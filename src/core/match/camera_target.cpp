#include "field_fusion/core/match/camera_target.h"

namespace field_fusion::core {

void carryToLidar(CameraTarget& target, const Eigen::Vector3d& ray, const Transform& T_lidar_camera) {
  if (!ray.allFinite() || !T_lidar_camera.matrix().allFinite()) return;
  target.direction = T_lidar_camera.linear() * ray;
  target.polar = polar(target.direction);
  target.polar.range = kNaN;
  if (!std::isfinite(target.ray_range)) return;
  target.position = T_lidar_camera * (target.ray_range * ray);
  target.polar = polar(target.position);
}

}  // namespace field_fusion::core
