#pragma once
// A plane that stays level while the body over it pitches and rolls.
#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Where the body stands over a level plane right below it: x is the body's heading, z is up. `T_up_body`
/// takes the body into any frame whose z axis is up; `height` [m] of the body's origin over the plane. A body
/// that stands on end has no heading: NaN.
inline Transform overLevelPlane(const Transform& T_up_body, double height) {
  const Eigen::Vector3d ahead = T_up_body.linear().col(0);
  Transform out = Transform::Identity();
  const double flat = ahead.head<2>().norm();
  Eigen::Matrix3d heading_up;  // rows: the heading's axes in the frame `up`
  heading_up << ahead.x() / flat, ahead.y() / flat, 0, -ahead.y() / flat, ahead.x() / flat, 0, 0, 0, 1;
  out.linear() = heading_up * T_up_body.linear();
  out.translation().z() = height;
  if (!(flat > 1e-6)) out.matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
  return out;
}

}  // namespace field_fusion::core
