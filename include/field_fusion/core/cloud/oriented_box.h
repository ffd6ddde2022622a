#pragma once
// The upright box that fits the seen faces of a body, because an axis-aligned box overstates its width.
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Upright (turned about z only). All NaN where it was not asked for.
struct OrientedBox {
  Eigen::Vector3f centre = Eigen::Vector3f::Constant(kNaN);  ///< [m]
  Eigen::Vector3f size = Eigen::Vector3f::Constant(kNaN);    ///< [m] along yaw, across it, up; x >= y
  float yaw = kNaN;  ///< [rad] of the longer side, counter-clockwise from x, in [-pi/2, pi/2)

  /// Whether `p` lies in the box grown by `margin` [m] on every side; false for a box of NaN.
  bool contains(const Eigen::Vector3f& p, float margin = 0.f) const {
    const Eigen::Vector3f d = p - centre;
    const float c = std::cos(yaw), s = std::sin(yaw);
    const Eigen::Array3f along(c * d.x() + s * d.y(), c * d.y() - s * d.x(), d.z());
    return (along.abs() <= 0.5f * size.array() + margin).all();
  }
};

/// Finds the turn of the box as Zhang et al. 2017 do (Efficient L-shape fitting of laser scanner data): a
/// search over all angles, to 0.2 deg. The criterion is the mean distance of the points to the nearest side:
/// the least area, another of theirs, is as small along the hypotenuse of two seen faces as along the faces.
/// Keeps its buffers from call to call.
class OrientedBoxFitter {
 public:
  /// Of at least one point, all finite. The size holds all points; the turn is found from no more than 256,
  /// every k-th in the order given.
  OrientedBox fit(const Point* points, std::size_t count);

 private:
  void sample(const Point* points, std::size_t count);
  float misfit(float yaw);
  float bestYaw();

  std::vector<float> x_, y_;  // relative to the first point
  std::vector<float> u_, v_;  // along and across the tried yaw
};

}  // namespace field_fusion::core
