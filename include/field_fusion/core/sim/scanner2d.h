#pragma once
// A scanner with one turning beam, such as SICK LMS141 and RPLIDAR A3.
#include "field_fusion/core/sim/beam_caster.h"

namespace field_fusion::core::sim {

struct Scanner2dParams {
  double rate = 50.0;
  double field_of_view = 270.0;
  double angle_step = 0.5;
  bool clockwise = false;
  bool at_once = false;
  LidarParams beam;

  void declare(Params& p) {
    p.number("rate", rate, {0.1, 1000.0}, "Hz", When::kStart, "Turns of the mirror.");
    p.number("field_of_view", field_of_view, {1.0, 360.0}, "deg", When::kStart,
             "Sector that is scanned, half to each side of forward.");
    p.number("angle_step", angle_step, {0.01, 10.0}, "deg", When::kStart, "From beam to beam.");
    p.flag("clockwise", clockwise, When::kStart, "Seen from above; the angles of a scan then fall.");
    p.flag("at_once", at_once, When::kStart,
           "All beams leave at the stamp: an ideal to compare with, whose scans no motion bends.");
    beam.declare(p);
    p.rule([this] { return wholeSteps(); }, "field_of_view must be a whole number of angle_step");
  }
  int steps() const { return static_cast<int>(std::lround(field_of_view / angle_step)); }

 private:
  bool wholeSteps() const { return std::abs(steps() * angle_step - field_of_view) < 1e-6 * field_of_view; }
};

/// As sensor_msgs/LaserScan; sensor frame x forward, y left.
struct Scan2d {
  double stamp = 0.0;  ///< [s] of the first beam
  float angle_min = 0.f, angle_max = 0.f,
        angle_increment = 0.f;                  ///< [rad] first, last, step; falls if clockwise
  float time_increment = 0.f, scan_time = 0.f;  ///< [s] between beams, between scans
  float range_min = 0.f, range_max = 0.f;       ///< [m]
  std::vector<float> ranges;  ///< [m] REP-117: +inf nothing seen, -inf too near, NaN nonsense
  std::vector<float> intensities;
};

class Scanner2d {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  Scanner2d(const Scanner2dParams& params, std::uint64_t seed);

  /// One scan whose first beam leaves at `stamp`. The result stays valid until the next call.
  const Scan2d& scan(Caster& caster, const PoseAt& T_world_sensor, double stamp);
  /// Of each beam of the last scan.
  const std::vector<BeamReturn>& truth() const { return beams_.returns(); }

  const Scanner2dParams& params() const { return params_; }
  const LidarNoise& noise() const { return beams_.noise(); }

 private:
  Scanner2dParams params_;
  BeamCaster beams_;
  Scan2d scan_;
};

}  // namespace field_fusion::core::sim
