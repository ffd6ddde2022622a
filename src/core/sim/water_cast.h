#pragma once
// Rays against the waves of Ground::height, eight at a time.
#include <vector>

#include "field_fusion/core/sim/world.h"
#include "field_fusion/core/sim/lanes.h"

namespace field_fusion::core::sim {

struct LineLanes {
  Lanes<double> origin[3], direction[3];  ///< [m], unit vectors
  Lanes<double> time;                     ///< [s]
};

/// [m] along each line: the ground is met not before `enter`, surely by `leave`. Both infinite: never.
struct BoundLanes {
  Lanes<double> enter, leave;
};

struct MeetingLanes {
  Lanes<double> range;             ///< [m] infinite: none
  Lanes<double> slope_x, slope_y;  ///< [m/m] rise of the ground there
};

class WaterCast {
 public:
  /// Throws std::invalid_argument for more than 32 waves.
  explicit WaterCast(const std::vector<Wave>& waves);

  void bounds(const LineLanes& lines, BoundLanes& out) const;
  /// Where those lines that are `wanted` (1, not 0) first meet the surface, from above or below.
  void meet(const LineLanes& lines, const Lanes<double>& wanted, MeetingLanes& out) const;

 private:
  struct WaveNumbers {
    double kx, ky, omega, phase, amplitude;
  };
  struct Search;
  void begin(const LineLanes& lines, const Lanes<double>& wanted, Search& s) const;
  void look(const LineLanes& lines, Search& s) const;
  static bool step(Search& s);

  std::vector<WaveNumbers> waves_;
  double highest_ = 0.0;   ///< [m] sum of the amplitudes
  double steepest_ = 0.0;  ///< [m/m] bound of the slope
  double bend_ = 0.0;      ///< [1/m] bound of the second derivative
};

}  // namespace field_fusion::core::sim
