#pragma once
// A detection as the LiDAR would see it.
#include <string>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// In the LiDAR's frame. A number that is not known is NaN.
struct CameraTarget {
  int id = 0;
  std::string label;
  double score = 0.0;                                           ///< 0..1
  double ray_range = kNaN;                                      ///< [m] from the camera, along the ray
  double range_sigma = kNaN;                                    ///< [m] standard deviation of ray_range
  Eigen::Vector3d direction = Eigen::Vector3d::Constant(kNaN);  ///< of the ray, unit vector
  Eigen::Vector3d position = Eigen::Vector3d::Constant(kNaN);   ///< [m]
  Polar polar{kNaN, kNaN, kNaN};  ///< of the position from the LiDAR; without range, angles of the direction
};

/// Fills in direction, position and polar of a target whose ray_range is set. `ray` is a unit vector in the
/// camera's optical frame. Without range the angles hold for a body far away against the distance between
/// the sensors. A ray or transform that is not finite leaves all NaN.
void carryToLidar(CameraTarget& target, const Eigen::Vector3d& ray, const Transform& T_lidar_camera);

}  // namespace field_fusion::core
