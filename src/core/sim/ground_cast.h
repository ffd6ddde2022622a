#pragma once
// Rays against the ground: plane and water by formula, rough ground as a mesh of its heights.
#include <vector>

#include "field_fusion/core/sim/world.h"
#include "ray_cut.h"

namespace field_fusion::core::sim {

/// The waves of Ground::height, four at a time: sines in single precision of phases reduced in double.
class Water {
 public:
  /// Throws std::invalid_argument for more than 32 waves.
  explicit Water(const std::vector<Wave>& waves);

  /// [m] to where the line first meets the surface from above or below; infinite: never.
  double range(const Line& line, double time) const;
  /// [m] bounds of that, found at once: met not before the first, surely met by the second.
  Span bounds(const Line& line) const;
  Eigen::Vector3d normal(double x, double y, double time) const;  ///< upwards

 private:
  struct Four {
    Eigen::Array4d kx, ky, omega, phase, amplitude;
  };
  struct Along;  // one line's phases; see the source
  static double polish(const Along& along, double t, double bend);

  Span band(const Line& line) const;  // the stretch between the highest crest and the deepest trough

  std::vector<Four> fours_;
  double highest_ = 0.0;   ///< [m] sum of the amplitudes
  double steepest_ = 0.0;  ///< [m/m] bound of the slope
  double bend_ = 0.0;      ///< [1/m] bound of the second derivative
};

/// Plane or water.
class GroundCast {
 public:
  explicit GroundCast(const Ground& ground) : ground_(ground), water_(ground.waves) {}

  /// [m] infinite: never.
  double range(const Line& line, double time) const;
  /// [m] bounds of that, found at once: met not before the first, surely met by the second.
  Span bounds(const Line& line) const;
  Eigen::Vector3d normal(const Eigen::Vector3d& at, double time) const;  ///< upwards

 private:
  const Ground& ground_;
  Water water_;
};

/// Heights of a rough ground on a square grid, an eighth of its grain apart or the extent / 768.
Mesh roughMesh(const Ground& ground);

}  // namespace field_fusion::core::sim
