#pragma once
// Small motions of a frame, for solvers: T = T_0 * (Exp(w), v), six numbers x = (w, v) that are zero at T_0. Written
// out rather than as a manifold of Ceres, whose name and form differ between its versions 1 and 2.
#include <array>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

using Chart = std::array<double, 6>;

/// Carries p to p moved by x.
inline Transform motion(const Chart& x) {
  const Eigen::Vector3d turn(x[0], x[1], x[2]);
  Transform T(turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()) : Eigen::AngleAxisd::Identity());
  T.translation() << x[3], x[4], x[5];
  return T;
}

/// x with T = T_0 * motion(x).
inline Eigen::Matrix<double, 6, 1> chartOf(const Transform& T_0, const Transform& T) {
  const Transform step = T_0.inverse() * T;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(step.linear()));
  Eigen::Matrix<double, 6, 1> x;
  x << turn.axis() * turn.angle(), step.translation();
  return x;
}

}  // namespace field_fusion::core
