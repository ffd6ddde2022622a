#pragma once
// A detection as its camera sees it and as the LiDAR would.
#include <cstdint>
#include <string>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// A box in the image as tangents y/x and z/x in the camera's view frame: its optical frame turned to x
/// forward, y left, z up. NaN throughout where it is not known.
struct ViewBox {
  double left = kNaN, right = kNaN, top = kNaN, bottom = kNaN;

  bool known() const { return std::isfinite(left + right + top + bottom); }
  /// Of a point of the view frame; the border is inside. `margin` [rad] makes the box larger on each side.
  bool contains(const Eigen::Vector3d& point, double margin = 0.0) const;
  double width() const { return std::atan(left) - std::atan(right); }   ///< [rad]
  double height() const { return std::atan(top) - std::atan(bottom); }  ///< [rad]
};

/// In the LiDAR's frame where not said otherwise. A number that is not known is NaN.
struct CameraTarget {
  int id = 0;
  std::string label;
  double score = 0.0;                                           ///< 0..1
  double ray_range = kNaN;                                      ///< [m] from the camera, along the ray
  double range_sigma = kNaN;                                    ///< [m] standard deviation of ray_range
  Eigen::Vector3d direction = Eigen::Vector3d::Constant(kNaN);  ///< of the ray, unit vector
  Eigen::Vector3d position = Eigen::Vector3d::Constant(kNaN);   ///< [m]
  Polar polar{kNaN, kNaN, kNaN};  ///< of the position from the LiDAR; without range, angles of the direction
  Polar seen{kNaN, kNaN, kNaN};   ///< from the camera, in its view frame
  ViewBox box;
  std::uint8_t cut = 0;           ///< Cut bits of the box
};

/// The detections of one camera of about the time of the clusters.
struct CameraView {
  std::vector<CameraTarget> targets;
  Transform T_view_lidar = Transform::Identity();
};

/// Turns x right, y down, z forward to x forward, y left, z up.
Transform viewFromOptical();

/// Fills in `seen` and `box` from unit vectors in the camera's optical frame: through the middle of the box,
/// its upper left and its lower right corner. A ray that is not finite or does not look forward leaves NaN.
void look(CameraTarget& target, const Eigen::Vector3d& ray, const Eigen::Vector3d& upper_left,
          const Eigen::Vector3d& lower_right);

/// Fills in direction, position and polar of a target whose ray_range is set. `ray` is a unit vector in the
/// camera's optical frame. Without range the angles hold for a body far away against the distance between
/// the sensors. A ray or transform that is not finite leaves all NaN.
void carryToLidar(CameraTarget& target, const Eigen::Vector3d& ray, const Transform& T_lidar_camera);

}  // namespace field_fusion::core
