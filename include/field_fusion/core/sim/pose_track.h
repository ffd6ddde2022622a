#pragma once
// Where a sensor is while it scans.
#include <functional>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core::sim {

/// T_world_sensor at a time [s], such as way.pose(time) * T_base_sensor.
using PoseAt = std::function<Transform(double time)>;

/// A span of a motion, sampled every millisecond and interpolated between: a pose for each beam would cost
/// more than the beam. A turn of 10 rad/s is met to 1e-5 rad and 100 m/s^2 to 0.02 mm.
class PoseTrack {
 public:
  struct Pose {
    Eigen::Quaternionf rotation;
    Eigen::Vector3f position;  ///< [m]
  };

  /// Throws std::invalid_argument for a span that is not finite or runs backwards.
  PoseTrack(const PoseAt& T_world_sensor, double begin, double end);

  /// T_world_sensor `time` seconds after the beginning; held at the ends.
  Pose at(float time) const;
  double begin() const { return begin_; }
  double end() const { return end_; }

 private:
  double begin_, end_;
  float step_ = 1.f;  // [s]
  std::vector<Pose> poses_;
};

}  // namespace field_fusion::core::sim
