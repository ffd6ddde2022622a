#pragma once
// Pinhole with plumb_bob distortion. Optical frame: x right, y down, z forward.
#include <cmath>
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/sim/camera_params.h"

namespace field_fusion::core::sim {

/// The distortion alone, without a branch, for loops.
template <class T>
struct PlumbBob {
  T fx, fy, cx, cy, k1, k2, k3, p1, p2;
  T widest;  ///< square of the largest radius that is distorted

  /// [px] of a point (x, y, 1), as Lens::project says; NaN for NaN.
  [[gnu::always_inline]] void pixel(T x, T y, T& u, T& v) const {
    const T far = widest / (x * x + y * y), root = std::sqrt(far), scale = far < T(1) ? root : T(1);
    const T a = scale * x, b = scale * y, r2 = a * a + b * b, radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    u = fx * (a * radial + 2 * p1 * a * b + p2 * (r2 + 2 * a * a)) + cx;
    v = fy * (b * radial + p1 * (r2 + 2 * b * b) + 2 * p2 * a * b) + cy;
  }
};

/// Brown's model as OpenCV and ROS have it; the inverse is found by iteration, once for each pixel.
class Lens {
 public:
  /// Throws std::invalid_argument naming a pixel that no ray reaches: such a distortion folds the picture.
  explicit Lens(const CameraParams& params);

  /// [px] of a point [m] or a direction, maybe outside of the picture. Beyond the widest angle that the
  /// distortion still widens, a pixel of that angle's ring. NaN for what is not in front.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const;
  template <class T>
  PlumbBob<T> formula() const {
    const CameraParams& c = params_;
    const double v[] = {c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.k3, c.p1, c.p2, widest_};
    return {T(v[0]), T(v[1]), T(v[2]), T(v[3]), T(v[4]), T(v[5]), T(v[6]), T(v[7]), T(v[8]), T(v[9])};
  }
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
