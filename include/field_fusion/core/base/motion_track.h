#pragma once
// How a sensor moves while it measures, and the way from each beam's own instant to one for all.
#include <vector>

#include "field_fusion/core/base/pose_history.h"

namespace field_fusion::core {

/// The instant at which all points of a sweep are expressed.
enum class Instant { kStart, kMiddle, kEnd };

/// Times [s] after a message's stamp between which its points were measured.
struct Sweep {
  double begin = 0.0, end = 0.0;

  double at(Instant instant) const {
    return instant == Instant::kStart ? begin : instant == Instant::kEnd ? end : 0.5 * (begin + end);
  }
};

/// Poses of the sensor as knots: one at every pose of the odometry, more where it turns fast, so that between
/// two of them a normalised mix of quaternions is the great arc and a mix of places the arc of the lever to
/// 10 um a metre. A slerp a point would cost more than all the rest. Keeps its buffer from sweep to sweep.
class MotionTrack {
 public:
  /// The sensor at `T_base_sensor` of a body whose poses are known throughout the sweep, about the pose at
  /// `instant` [s after the stamp], which lies in it too.
  void follow(const PoseHistory& history, double stamp, const Sweep& sweep, double instant,
              const Transform& T_base_sensor);

  /// A sensor that moves with constant `velocity` [m/s] and `turn_rate` [rad/s] in its own frame.
  void keepOn(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate, const Sweep& sweep,
              double instant);

  /// From the sensor at a time [s after the stamp] into the sensor at the instant. Times outside the sweep
  /// count as its ends. Fast where times come in order.
  struct Pose {
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    Eigen::Vector3f operator*(const Eigen::Vector3f& p) const { return rotation * p + position; }
  };
  const Pose& at(float time);

 private:
  struct Knot {
    float time;
    Eigen::Quaternionf rotation;
    Eigen::Vector3f position;
  };
  void begin();
  void add(double time, const Transform& T_instant_sensor);

  std::vector<Knot> knots_;
  std::size_t segment_ = 0;
  float time_ = kNaN;  // of pose_
  Pose pose_;
};

/// How far a body comes in `time` that keeps both in its own frame: the exponential of SE(3).
Transform keptOn(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate, double time);

}  // namespace field_fusion::core
