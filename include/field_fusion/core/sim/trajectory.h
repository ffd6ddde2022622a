#pragma once
// Where things are at any time.
#include <functional>
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
  /// [m/s] on the way: from here on it shakes in full, slower it shakes less and at rest not at all, as steps
  /// and a road do. Turns on the spot count too. 0: always in full, as on waves.
  double full_speed = 0.0;

  /// T_way_body; `share` 0..1 of the amplitudes.
  Transform at(double time, double share = 1.0) const;
};

/// A smooth way through way-points, run with limited speed and acceleration, or standing still at one.
/// Position and velocity are continuous. Time starts at 0; before it and after the end the body stands.
///
/// Corners are rounded, at the highest speed that the limits allow; acceleration and turn rate are zero at
/// both ends of the curve, so that the turn rate does not jump either. Where the way turns by more than 120
/// degrees, at way-points with a yaw or a pause, and at the first one of a loop, the body stops and turns on
/// the spot.
class Trajectory {
 public:
  struct WayPoint {
    Eigen::Vector3d position;  ///< [m]
    double yaw = kNaN;         ///< [rad] turns to it on the spot; NaN: along the way
    double pause = 0.0;        ///< [s] stands here so long
  };
  struct Limits {
    double speed = 1.0;         ///< [m/s]
    double acceleration = 0.5;  ///< [m/s^2]
    double turn_rate = 1.0;     ///< [rad/s]
    double corner = 0.3;        ///< [m] how near to a way-point a rounded corner passes; 0: stops at each
    bool loop = false;          ///< begins again at the end; the first way-point is also the last
  };
  /// Puts the body on a ground: from T_world_way, that is the way alone, to T_world_body before its shake.
  using Carrier = std::function<Transform(const Transform& T_world_way, double time)>;

  /// Stands at the origin.
  Trajectory() : Trajectory({WayPoint{Eigen::Vector3d::Zero(), 0.0, 0.0}}, {}) {}
  /// Throws std::invalid_argument without way-points, for limits not above 0, for numbers that are not
  /// finite, and for two way-points in a row at one place that do not differ in their yaws.
  Trajectory(const std::vector<WayPoint>& points, const Limits& limits, const Shake& shake = {});

  /// The same way, put on a ground. `moves`: also a body that stands, such as a buoy on waves.
  Trajectory carriedBy(Carrier carrier, bool moves) const;

  Transform pose(double time) const;  ///< T_world_body, the shake included
  /// [m/s] and [rad/s], in the body's frame, by central differences over 1 ms.
  Eigen::Vector3d velocity(double time) const;
  Eigen::Vector3d angularVelocity(double time) const;
  double duration() const;  ///< [s] from the start to the end of the way, or of a lap; 0 for one way-point
  bool still() const;       ///< never moves

 private:
  struct Path;  // see the source
  std::shared_ptr<const Path> path_;
};

}  // namespace field_fusion::core::sim
