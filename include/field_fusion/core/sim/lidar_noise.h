#pragma once
// From what the light of one beam meets to what the sensor says: energy, merging of returns, drop-outs,
// errors.
#include <vector>

#include "field_fusion/core/sim/beam_random.h"
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/lidar_params.h"

namespace field_fusion::core::sim {

/// A part of a beam's light: the surface that it met, or nothing.
struct Glint {
  float range = std::numeric_limits<float>::infinity();  ///< [m]
  float energy = 0.f;  ///< of a white target hit squarely at 1 m by the whole beam: 1
  int body = Hit::kNothing;
};

/// What a beam reports, and the truth of it.
struct BeamReturn {
  float range;       ///< [m] REP-117: +inf nothing seen, -inf too near, NaN nonsense
  float intensity;   ///< 0..255
  float true_range;  ///< [m] along the middle of the beam; +inf where that meets nothing
  int body;          ///< whose surface gave most of the return, as Hit::body; kNothing without return
  bool mixed;        ///< the return is of several surfaces at different ranges
};

/// Full width and height of the spot [m].
Eigen::Vector2f spotSize(const LidarParams& params, float range);

/// Energy that a hit by the whole beam sends back: reflectivity cos(incidence) / range^2 of what is not
/// mirrored away. Light that a glossy surface mirrors is lost; the glare of a mirror square to the beam is
/// not modelled.
float echoEnergy(const Hit& hit, const Eigen::Vector3f& direction);

class LidarNoise {
 public:
  /// Draws what is wrong with this one sensor: the range bias of each row and the scale.
  LidarNoise(const LidarParams& params, int rows, std::uint64_t seed);

  /// `glints` (one at least, the middle of the beam first) are sorted. `slope`: tangent of the incidence.
  BeamReturn measure(Glint* glints, int count, float slope, int row, BeamRandom& random) const;

  float bias(int row) const { return biases_[row]; }  ///< [m]
  float scale() const { return scale_; }
  float threshold() const { return threshold_; }  ///< energy of a return that is seen every other time

 private:
  struct Pulse {
    float range = 0.f, energy = 0.f, spread = 0.f;
    int body = Hit::kNothing;
  };
  Pulse reported(const Glint* glints, int count, float gain) const;
  float erroneous(float range, float energy, float slope, int row, BeamRandom& random) const;
  float intensity(float range, float energy) const;

  LidarParams params_;
  std::vector<float> biases_;
  float scale_, threshold_;
};

}  // namespace field_fusion::core::sim
