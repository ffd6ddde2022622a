#pragma once
// Colour of water: it mirrors the sky and the sun with waves of its own, too small to be in the world.
#include <array>

#include "sky.h"

namespace field_fusion::core::sim {

/// How water looks at one place.
struct WaterLook {
  Eigen::Vector3f mirrored;  ///< unit vector of what it reflects
  float share = 0.f;         ///< 0..1, of light that is reflected
  float glitter = 0.f;       ///< radiance of the sun in it over the sun's on a white sheet
};

class Ripples {
 public:
  Ripples();

  /// `footprint` [m] is what a pixel covers: waves below it are no shapes any more but roughness.
  WaterLook look(const Eigen::Vector3f& place, const Eigen::Vector3f& normal,
                 const Eigen::Vector3f& direction, const Eigen::Vector3f& to_sun, double time,
                 float footprint) const;

 private:
  static constexpr int kWaves = 12;
  using Waves = Eigen::Array<float, kWaves, 1>;
  Waves kx_, ky_, omega_, phase_, length_;
};

}  // namespace field_fusion::core::sim
