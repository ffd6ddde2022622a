#include "field_fusion/core/match/camera_target.h"

#include <algorithm>

namespace field_fusion::core {

bool ViewBox::contains(const Eigen::Vector3d& point, double margin) const {
  if (!(point.x() > 0.0)) return false;
  const double sideways = std::atan(point.y() / point.x()), up = std::atan(point.z() / point.x());
  return sideways <= std::atan(left) + margin && sideways >= std::atan(right) - margin &&
         up <= std::atan(top) + margin && up >= std::atan(bottom) - margin;
}

Transform viewFromOptical() {
  Transform T_view_optical = Transform::Identity();
  T_view_optical.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_view_optical;
}

void look(CameraTarget& target, const Eigen::Vector3d& ray, const Eigen::Vector3d& upper_left,
          const Eigen::Vector3d& lower_right) {
  const Transform T_view_optical = viewFromOptical();
  if (ray.allFinite()) {
    target.seen = polar(T_view_optical * ray);
    target.seen.range = target.ray_range;
  }
  const Eigen::Vector3d from = T_view_optical * upper_left, to = T_view_optical * lower_right;
  if (from.x() > 0.0 && to.x() > 0.0)
    target.box = {from.y() / from.x(), to.y() / to.x(), from.z() / from.x(), to.z() / to.x()};
}

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
