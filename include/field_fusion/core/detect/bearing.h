#pragma once
// The direction in which a pixel looks. Camera's optical frame: x right, y down, z forward (REP-103).
#include <Eigen/Core>

#include <opencv2/core/types.hpp>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Camera without distortion: pixels must be rectified before they come here. [px]
struct Pinhole {
  double fx = 0, fy = 0, cx = 0, cy = 0;

  /// False for a camera that was never calibrated (K = 0 in ROS); all that follows from it is NaN.
  bool known() const { return fx > 0 && fy > 0 && std::isfinite(fx + fy + cx + cy); }
};

struct Bearing {
  Eigen::Vector3d ray;  ///< unit vector, optical frame
  /// [rad] against the optical axis, left is positive: -theta_x of paper 001 Eqs. 4-6, which is
  /// clockwise positive and in degrees.
  double azimuth;
  /// [rad] of the ray above the camera's horizontal plane, up is positive. On the column cx it is
  /// -theta_y of Eq. 5; beside it the paper's angle, taken in the y-z plane, is larger.
  double elevation;
};

/// Through a rectified pixel [px]; all NaN for an unknown camera.
Bearing bearing(cv::Point2d pixel, const Pinhole& camera);

}  // namespace field_fusion::core
