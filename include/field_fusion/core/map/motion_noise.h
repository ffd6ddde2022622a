#pragma once
// How far odometry can be trusted.
#include <Eigen/Core>

#include <cmath>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/pose2.h"

namespace field_fusion::core {

/// Standard deviations per way and turn, with the effect that Gmapping's parameters of these names have.
struct MotionNoise {
  double srr = 0.1, srt = 0.2, str = 0.1, stt = 0.2;

  void declare(Params& p) {
    p.number("srr", srr, {0.0, 10.0}, "m/m", When::kLive, "Odometry: error of the way by the way.");
    p.number("srt", srt, {0.0, 10.0}, "rad/m", When::kLive, "Odometry: error of the turn by the way.");
    p.number("str", str, {0.0, 10.0}, "m/rad", When::kLive, "Odometry: error of the way by the turn.");
    p.number("stt", stt, {0.0, 10.0}, "rad/rad", When::kLive, "Odometry: error of the turn by the turn.");
  }
};

/// Motion between two scans by odometry. `way` and `turn` also count what was undone again.
struct Motion {
  Pose2 step;         ///< T_before_now
  double way = 0.0;   ///< [m]
  double turn = 0.0;  ///< [rad]
};

/// Of the step's x [m], y [m], yaw [rad], in the frame of the pose before. Sideways errors by the way are 0.3 of
/// those along it, as in Gmapping; never singular, because a robot that stands is shaken too.
inline Eigen::Matrix3d covariance(const Motion& motion, const MotionNoise& noise) {
  constexpr double kLeast = 0.005, kLeastYaw = 0.003;  // m, rad
  const double along = std::abs(motion.step.x), across = std::abs(motion.step.y);
  const double norm = along + across > 0.0 ? motion.way / std::hypot(along, across) : 0.0;
  const double turned = noise.str * motion.turn + kLeast;
  const double sx = noise.srr * norm * (along + 0.3 * across) + turned;
  const double sy = noise.srr * norm * (across + 0.3 * along) + turned;
  const double st = noise.stt * motion.turn + noise.srt * motion.way + kLeastYaw;
  return Eigen::Vector3d(sx * sx, sy * sy, st * st).asDiagonal();
}

}  // namespace field_fusion::core
