#pragma once
// Where things are at any time.
#include <memory>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core::sim {

/// Regular shaking about the way: waves, gait or road.
struct Shake {
  /// One oscillation: amplitude sin(2 pi frequency t + phase), of roll, pitch, yaw [rad] and x, y, z [m].
  struct Term {
    Eigen::Matrix<double, 6, 1> amplitude = Eigen::Matrix<double, 6, 1>::Zero();
    double frequency = 1.0;                                                   ///< [Hz]
    Eigen::Matrix<double, 6, 1> phase = Eigen::Matrix<double, 6, 1>::Zero();  ///< [rad]
  };
  std::vector<Term> terms;
  Transform at(double time) const;  ///< T_way_body
};

/// A smooth way through way-points, run with limited speed and acceleration, or standing still at one.
/// Position and velocity are continuous. Time starts at 0; before it and after the end the body stands.
class Trajectory {
 public:
  struct WayPoint {
    Eigen::Vector3d position;  ///< [m]
    double yaw = kNaN;         ///< [rad] NaN: along the way
    double pause = 0.0;        ///< [s] stands here so long
  };
  struct Limits {
    double speed = 1.0;         ///< [m/s]
    double acceleration = 0.5;  ///< [m/s^2]
    double turn_rate = 1.0;     ///< [rad/s] for turns on the spot
    bool loop = false;          ///< begins again at the end; the first way-point is also the last
  };

  /// Stands at the origin.
  Trajectory() : Trajectory({WayPoint{Eigen::Vector3d::Zero(), 0.0, 0.0}}, {}) {}
  /// Throws std::invalid_argument without way-points, for limits not above 0 and for numbers that are not
  /// finite.
  Trajectory(const std::vector<WayPoint>& points, const Limits& limits, const Shake& shake = {});

  Transform pose(double time) const;  ///< T_world_body, the shake included
  /// [m/s] and [rad/s], in the body's frame, by central differences over 1 ms.
  Eigen::Vector3d velocity(double time) const;
  Eigen::Vector3d angularVelocity(double time) const;
  double duration() const;  ///< [s] from the start to the end of the way; 0 for one way-point
  bool still() const;       ///< never moves

 private:
  struct Path;  // see the source
  std::shared_ptr<const Path> path_;
};

}  // namespace field_fusion::core::sim
