#pragma once
// Colour of water: it mirrors the sky and the sun with waves of its own, too small to be in the world.
#include <Eigen/Core>

#include "field_fusion/core/sim/lanes.h"

namespace field_fusion::core::sim {

/// How water looks at one place.
struct WaterLook {
  Eigen::Vector3f mirrored;  ///< unit vector of what it reflects
  float share = 0.f;         ///< 0..1, of light that is reflected
  float glitter = 0.f;       ///< radiance of the sun in it over the sun's on a white sheet
};

/// Eight places on the water and the lines along which they are seen.
struct WaterPlaces {
  Lanes<float> x, y;                  ///< [m]
  Lanes<float> normal[3], sight[3];   ///< unit vectors: of the waves in the world, from the eye
  Lanes<float> footprint;             ///< [m] that a pixel covers: waves below it are roughness, no shapes
};

class Ripples {
 public:
  explicit Ripples(const Eigen::Vector3f& to_sun);

  /// Of the first `count` places.
  void look(const WaterPlaces& places, double time, WaterLook* out, std::size_t count) const;

 private:
  static constexpr int kWaves = 12;

  struct Wave {
    float kx, ky, omega, phase;  // [rad/m], [rad/s], [rad]
    float ahead_x, ahead_y;      // unit vector that it runs along
    float length;                // [m]
  };
  struct Shape;  // of the surface
  struct Light;
  void shape(const WaterPlaces& places, double time, Shape& s) const;
  void light(const WaterPlaces& places, const Shape& s, Light& l) const;
  void lookAt(const WaterPlaces& places, double time, Light& l) const;

  float to_sun_[3];
  Wave waves_[kWaves];
};

}  // namespace field_fusion::core::sim
