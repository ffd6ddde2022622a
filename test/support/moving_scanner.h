#pragma once
// A scanner that moves through a room while it turns, by analysis: every beam at its own instant.
#include <functional>

#include "field_fusion/core/base/motion_track.h"
#include "field_fusion/core/scan/scan.h"

namespace field_fusion::test {

/// T_world_base at a time [s].
using Motion = std::function<core::Transform(double)>;

/// From (x, y, 0) on at a steady velocity [m/s] in the world while turning about an axis at `rate` [rad/s].
inline Motion steady(const Eigen::Vector3d& velocity, const Eigen::Vector3d& axis, double rate) {
  return [=](double time) {
    core::Transform out = core::Transform::Identity();
    out.translation() = time * velocity;
    out.linear() = Eigen::AngleAxisd(rate * time, axis.normalized()).toRotationMatrix();
    return out;
  };
}

/// Trots ahead at 1 m/s and 60 deg/s while rolling and pitching by 5 degrees.
inline core::Transform trot(double time) {
  using core::radians;
  const double beat = 2.0 * radians(180.0) * 2.0 * time;
  core::Transform out = core::Transform::Identity();
  out.translate(Eigen::Vector3d(time, 0.1 * std::sin(time), 0.02 * std::sin(2.0 * beat)));
  out.rotate(Eigen::AngleAxisd(radians(60.0) * time, Eigen::Vector3d::UnitZ()));
  out.rotate(Eigen::AngleAxisd(radians(5.0) * std::sin(beat), Eigen::Vector3d::UnitY()));
  out.rotate(Eigen::AngleAxisd(radians(5.0) * std::cos(beat), Eigen::Vector3d::UnitX()));
  return out;
}

/// The poses of a motion at `rate` [Hz] from `begin` to `end` [s].
inline core::PoseHistory historyOf(const Motion& motion, double begin, double end, double rate = 500.0) {
  core::PoseHistory out;
  const int samples = static_cast<int>(std::lround((end - begin) * rate));
  for (int i = 0; i <= samples; ++i) {
    const double time = begin + i / rate;
    const core::Transform pose = motion(time);
    out.add({time, pose.translation(), Eigen::Quaterniond(pose.linear())});
  }
  return out;
}

/// A room about the world's origin, with walls at +-`half` [m]; high, so that a tilted beam meets them too.
struct Room {
  Eigen::Vector2d half{5.0, 3.0};

  double range(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
      const double wall = to[axis] > 0.0 ? half[axis] : -half[axis];
      if (to[axis] != 0.0) nearest = std::min(nearest, (wall - from[axis]) / to[axis]);
    }
    return nearest;
  }
  /// How far a place is from the nearest wall.
  double off(const Eigen::Vector3d& place) const {
    return (half - place.head<2>().cwiseAbs()).cwiseAbs().minCoeff();
  }
};

struct Scanner {
  int beams = 1600;
  double rate = 10.0;  // Hz
  bool clockwise = false;
  core::Transform T_base_scanner = core::Transform::Identity();

  double timeIncrement() const { return 1.0 / rate / beams; }
  core::Sweep sweep() const { return {0.0, (beams - 1) * timeIncrement()}; }
  core::Transform pose(const Motion& motion, double time) const { return motion(time) * T_base_scanner; }
  static Eigen::Vector3d direction(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

  core::Scan scan(const Room& room, const Motion& motion, double stamp) const {
    core::Scan out;
    const double step = (clockwise ? -1.0 : 1.0) * core::radians(360.0) / beams;
    out.angle_min = -0.5 * beams * step;
    out.angle_increment = step;
    out.time_increment = timeIncrement();
    out.scan_time = 1.0 / rate;
    out.range_min = 0.1, out.range_max = 25.0;
    for (int i = 0; i < beams; ++i) {
      const core::Transform at = pose(motion, stamp + i * timeIncrement());
      const Eigen::Vector3d to = at.linear() * direction(out.angle(static_cast<std::size_t>(i)));
      out.ranges.push_back(static_cast<float>(room.range(at.translation(), to)));
      out.intensities.push_back(static_cast<float>(i));
    }
    return out;
  }
};

}  // namespace field_fusion::test
