#pragma once
// A turning LiDAR with several lasers above each other, such as Velodyne VLP-16 and HDL-64E, RoboSense
// Helios-16.
#include "field_fusion/core/sim/beam_caster.h"

namespace field_fusion::core::sim {

struct Lidar3dParams {
  double rate = 10.0;
  double column_time = 55.296;
  double first_azimuth = 180.0;
  bool clockwise = true;
  std::vector<double> elevations = {-15, -13, -11, -9, -7, -5, -3, -1, 1, 3, 5, 7, 9, 11, 13, 15};
  std::vector<double> fire_times = {0};
  LidarParams beam;

  void declare(Params& p) {
    p.number("rate", rate, {0.1, 100.0}, "Hz", When::kStart, "Turns of the head.");
    p.number("column_time", column_time, {1.0, 100000.0}, "us", When::kStart,
             "From a shot of a laser to its next.");
    p.number("first_azimuth", first_azimuth, {-360.0, 360.0}, "deg", When::kStart,
             "Where a turn begins, counter-clockwise from forward.");
    p.flag("clockwise", clockwise, When::kStart, "Sense of the turn, seen from above.");
    p.number("elevations", elevations, {-89.0, 89.0}, "deg", When::kStart,
             "Of each laser, from the lowest (ring 0) to the highest.");
    p.number("fire_times", fire_times, {0.0, 100000.0}, "us", When::kStart,
             "When each laser fires within a column. One number: that long after the one below it.");
    beam.declare(p);
    p.rule([this] { return rising(); }, "elevations must rise");
    p.rule([this] { return fire_times.size() == 1 || fire_times.size() == elevations.size(); },
           "fire_times must hold one number, or one for each of elevations");
    p.rule([this] { return columns() > 0; }, "column_time must be shorter than a turn");
  }
  int columns() const { return static_cast<int>(1e6 / (rate * column_time)); }
  /// [s] after the column's start.
  double fireTime(std::size_t ring) const {
    return 1e-6 * (fire_times.size() == 1 ? static_cast<double>(ring) * fire_times[0] : fire_times[ring]);
  }

 private:
  bool rising() const {
    for (std::size_t i = 1; i < elevations.size(); ++i)
      if (!(elevations[i] > elevations[i - 1])) return false;
    return !elevations.empty();
  }
};

/// Sensor frame x forward, z up. Every point as it was seen from where the sensor was at its time: motion
/// distorts the cloud. Beams without a return are left out.
class Lidar3d {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  Lidar3d(const Lidar3dParams& params, std::uint64_t seed);

  /// One turn that begins at `stamp`, in the order of columns, and in each from ring 0 up; Point::time counts
  /// from `stamp`. The result stays valid until the next call.
  const Cloud& scan(Caster& caster, const PoseAt& T_world_sensor, double stamp);
  /// Of each point of the last cloud.
  const std::vector<BeamReturn>& truth() const { return truth_; }

  const Lidar3dParams& params() const { return params_; }
  const LidarNoise& noise() const { return beams_.noise(); }

 private:
  Lidar3dParams params_;
  BeamCaster beams_;
  Cloud cloud_;
  std::vector<BeamReturn> truth_;
};

}  // namespace field_fusion::core::sim
