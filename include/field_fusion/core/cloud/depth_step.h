#pragma once
// Whether two points of a scan lie at the same depth: the angle beta of paper 001 Eq. 7.
#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// The right triangle of paper 001 Eq. 7. O is the sensor, A the point farther from it, B the other, and C
/// the foot of B on the ray OA. The sides are kept times |OA|, because the tests need no root then.
struct DepthStep {
  double across2 = 0.0;  ///< [m^4] (|BC| |OA|)^2
  double along = 0.0;    ///< [m^2] |AC| |OA|, not negative
  double range2 = 0.0;   ///< [m^2] |OA|^2

  /// [rad] beta, in [0, pi / 2]: small for a step in depth, pi / 2 at equal range. 0 for points on one ray
  /// and for a point at O; pi / 2 for equal points, which is the limit of points at equal range.
  double beta() const { return along == 0.0 ? radians(90.0) : std::atan2(std::sqrt(across2), along); }

  bool alongWithin(double limit) const { return along * along <= limit * limit * range2; }
  bool acrossWithin(double limit) const { return across2 <= limit * limit * range2; }
};

/// The triangle of two points in the sensor's frame, in either order.
inline DepthStep depthStep(const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
  const Eigen::Vector3d a = p.cast<double>(), b = q.cast<double>();
  const double range2 = std::max(a.squaredNorm(), b.squaredNorm());
  return {a.cross(b).squaredNorm(), std::max(0.0, range2 - a.dot(b)), range2};
}

/// beta > theta without a trigonometric function for each pair.
class BetaTest {
 public:
  /// `theta` [rad] in [0, pi / 2).
  explicit BetaTest(double theta = 0.0) : tan2_(std::tan(theta) * std::tan(theta)) {}
  bool operator()(const DepthStep& step) const {
    return step.along == 0.0 || step.across2 > tan2_ * step.along * step.along;
  }

 private:
  double tan2_;
};

}  // namespace field_fusion::core
