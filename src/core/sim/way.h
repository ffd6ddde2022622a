#pragma once
// The way through way-points as pieces in time; see Trajectory.
#include <vector>

#include "field_fusion/core/sim/trajectory.h"

namespace field_fusion::core::sim {

/// A stretch of the way: a polynomial of the time since its begin, and a yaw that turns steadily or follows
/// the velocity.
struct Piece {
  double begin = 0.0, length = 0.0;                                ///< [s]
  Eigen::Vector3d p0, p1 = Eigen::Vector3d::Zero();                ///< [m], [m/s]
  Eigen::Vector3d p2 = Eigen::Vector3d::Zero(), p3 = p2, p4 = p2;  ///< [m/s^2] ...
  double yaw0 = 0.0, yaw1 = 0.0, yaw2 = 0.0;                       ///< [rad], [rad/s], [rad/s^2]
  bool along = false;                                              ///< yaw follows the velocity

  Eigen::Vector3d position(double t) const { return p0 + t * (p1 + t * (p2 + t * (p3 + t * p4))); }
  Eigen::Vector3d velocity(double t) const { return p1 + t * (2 * p2 + t * (3 * p3 + t * 4 * p4)); }
  double yaw(double t) const {
    if (!along) return yaw0 + t * (yaw1 + t * yaw2);
    const Eigen::Vector3d v = velocity(t);
    return std::atan2(v.y(), v.x());
  }
};

/// At least one piece; the last one ends at rest.
std::vector<Piece> planWay(const std::vector<Trajectory::WayPoint>& points, const Trajectory::Limits& limits);

}  // namespace field_fusion::core::sim
