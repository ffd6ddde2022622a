#include "field_fusion/core/match/box_fit.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

/// Cosine between the line of sight and a side, from which on the side's near end is seen.
constexpr double kAlong = 0.3;

double square(double x) { return x * x; }

/// By how much a seen pair of sides differs from a class: the longer, and what of the other is too long.
double mismatch(const Eigen::Vector2d& seen, double longer, double other) {
  return std::abs(seen.x() - longer) + std::max(0.0, seen.y() - other);
}

}  // namespace

BoxFit completed(const OrientedBox& seen, const ClassShape& shape, double spread, double noise) {
  const Eigen::Vector2d size = seen.size.head<2>().cast<double>();
  const bool lengthwise =
      mismatch(size, shape.length, shape.width) <= mismatch(size, shape.width, shape.length);
  const Eigen::Vector2d whole = lengthwise ? Eigen::Vector2d(shape.length, shape.width)
                                           : Eigen::Vector2d(shape.width, shape.length);
  BoxFit out;
  out.yaw = seen.yaw;
  out.centre = seen.centre.head<2>().cast<double>();
  out.size = size;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(out.yaw).toRotationMatrix();
  const Eigen::Vector2d sight = turn.transpose() * out.centre.normalized();
  Eigen::Vector2d variance;
  for (int axis = 0; axis < 2; ++axis) {
    const double missing = std::max(0.0, whole[axis] - size[axis]);
    const bool known = std::abs(sight[axis]) >= kAlong;
    variance[axis] = square(noise) + (known ? square(0.5 * spread * whole[axis]) : square(missing) / 12.0);
    if (!known) continue;
    out.centre += turn.col(axis) * std::copysign(0.5 * missing, sight[axis]);
    out.size[axis] += missing;
  }
  out.covariance = turn * variance.asDiagonal() * turn.transpose();
  return out;
}

}  // namespace field_fusion::core
