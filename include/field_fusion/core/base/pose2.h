#pragma once
// Poses in the plane.
#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// T_target_source of a motion in the plane: [m], [m], [rad] in [-pi, pi] where a function here made it.
struct Pose2 {
  double x = 0.0, y = 0.0, yaw = 0.0;

  Eigen::Vector2d position() const { return {x, y}; }
  bool finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(yaw); }
};

struct StampedPose2 {
  std::int64_t stamp_ns = 0;
  Pose2 pose;
};

/// T_a_c = T_a_b * T_b_c.
inline Pose2 operator*(const Pose2& a, const Pose2& b) {
  const double c = std::cos(a.yaw), s = std::sin(a.yaw);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, angleDifference(a.yaw + b.yaw, 0.0)};
}

inline Pose2 inverse(const Pose2& p) {
  const double c = std::cos(p.yaw), s = std::sin(p.yaw);
  return {-c * p.x - s * p.y, s * p.x - c * p.y, angleDifference(-p.yaw, 0.0)};
}

/// T_a_b from the poses of a and b in one frame.
inline Pose2 between(const Pose2& a, const Pose2& b) { return inverse(a) * b; }

/// A point of the pose's frame in the frame that the pose is given in.
inline Eigen::Vector2d operator*(const Pose2& p, const Eigen::Vector2d& point) {
  const double c = std::cos(p.yaw), s = std::sin(p.yaw);
  return {p.x + c * point.x() - s * point.y(), p.y + s * point.x() + c * point.y()};
}

/// What of a motion in space lies in the plane.
inline Pose2 flat(const Transform& T) {
  return {T.translation().x(), T.translation().y(), std::atan2(T.linear()(1, 0), T.linear()(0, 0))};
}

inline Transform solid(const Pose2& p) {
  return Eigen::Translation3d(p.x, p.y, 0.0) * Eigen::AngleAxisd(p.yaw, Eigen::Vector3d::UnitZ());
}

}  // namespace field_fusion::core
