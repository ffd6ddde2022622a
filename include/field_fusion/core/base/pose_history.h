#pragma once
// The last poses of a body by its odometry, and where it stood between two of them (paper 004, Eqs. 1 and 2).
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

struct PoseHistoryParams {
  double max_gap = 0.25;
  double max_speed = 20.0;
  double max_turn_rate = 1000.0;

  void declare(Params& p) {
    p.number("max_gap", max_gap, {0.001, 10.0}, "s", When::kLive,
             "Poses farther apart in time are not interpolated.");
    p.number("max_speed", max_speed, {0.1, 1000.0}, "m/s", When::kLive,
             "Poses farther apart than this speed explains are a leap: not interpolated.");
    p.number("max_turn_rate", max_turn_rate, {1.0, 100000.0}, "deg/s", When::kLive,
             "The same for the rotation.");
  }
};

struct TimedPose {
  double time = 0.0;                                   ///< [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  Transform transform() const { return Eigen::Translation3d(position) * rotation; }
};

/// Linear in the position, along the great arc in the rotation. `share` 0 is a, 1 is b.
TimedPose interpolate(const TimedPose& a, const TimedPose& b, double share);

/// Holds the newest poses in a ring of fixed size: 4096 are 8 s of 500 Hz. Never allocates after its making.
class PoseHistory {
 public:
  enum class Cover {
    kWhole,
    kNotYet,  ///< ends too early: what is missing may still come
    kBegun,   ///< begins too late: what is missing will never come
    kGap,     ///< two neighbours lie too far apart in time
    kLeap     ///< or in space: a reset of the odometry
  };

  /// Throws std::invalid_argument with every fault of the parameters.
  explicit PoseHistory(const PoseHistoryParams& params = {}, std::size_t capacity = 4096);
  void setParams(const PoseHistoryParams& params);

  /// False where the pose is not newer than the last: it is left out. Throws std::runtime_error
  /// "pose damaged: ..." where a number is not finite or the quaternion is not of length 1.
  bool add(const TimedPose& pose);
  void clear() { count_ = 0; }

  /// Whether every instant of [begin, end] can be told.
  Cover cover(double begin, double end) const;

  /// At a time that is covered; throws std::out_of_range before the first or after the last pose.
  TimedPose at(double time) const;

  std::size_t size() const { return count_; }
  /// 0 is the oldest.
  const TimedPose& operator[](std::size_t i) const {
    return ring_[(next_ + ring_.size() - count_ + i) % ring_.size()];
  }
  /// The first pose that is later than `time`; size() where there is none.
  std::size_t firstAfter(double time) const;

 private:
  PoseHistoryParams params_;
  std::vector<TimedPose> ring_;
  std::size_t next_ = 0, count_ = 0;
};

/// "the odometry ends before it", of everything but kWhole.
const char* describe(PoseHistory::Cover cover);

}  // namespace field_fusion::core
