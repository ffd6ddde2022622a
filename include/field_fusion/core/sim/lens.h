#pragma once
// Pinhole with plumb_bob distortion. Optical frame: x right, y down, z forward.
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/sim/camera_params.h"

namespace field_fusion::core::sim {

/// Brown's model as OpenCV and ROS have it; the inverse is found by iteration, once for each pixel.
class Lens {
 public:
  /// Throws std::invalid_argument naming a pixel that no ray reaches: such a distortion folds the picture.
  explicit Lens(const CameraParams& params);

  /// [px] of a point [m] or a direction, maybe outside of the picture. Beyond the widest angle that the
  /// distortion still widens, a pixel of that angle's ring. NaN for what is not in front.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const;
  /// Unit vector of the middle of a pixel.
  const Eigen::Vector3f& ray(int u, int v) const { return rays_[static_cast<std::size_t>(v) * width_ + u]; }
  /// As above, of a place within half a pixel of the middle, to 1e-4 px.
  Eigen::Vector3f ray(int u, int v, float right, float down) const;
  double pixelAngle() const { return 1.0 / params_.fx; }  ///< [rad] about, in the middle
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Eigen::Vector2d distorted(const Eigen::Vector2d& p, Eigen::Matrix2d* jacobian) const;
  Eigen::Vector2d undistorted(const Eigen::Vector2d& pixel, Eigen::Vector2d start) const;

  CameraParams params_;
  int width_, height_;
  double widest_;  // square of the largest undistorted radius
  std::vector<Eigen::Vector3f> rays_;
};

/// The optical frame of a sensor that looks along x, y left, z up.
Transform sensorToOptical();

}  // namespace field_fusion::core::sim
