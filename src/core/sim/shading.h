#pragma once
// From what rays hit to the light that comes along them.
#include <memory>
#include <vector>

#include "field_fusion/core/sim/caster.h"
#include "sky.h"
#include "water_look.h"

namespace field_fusion::core::sim {

class Shader {
 public:
  /// Of one thread.
  struct Scratch {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<std::size_t> pixels;
    std::vector<std::size_t> water;         // pixels that show it
    std::vector<WaterLook> looks;           // of these
    std::vector<Eigen::Vector3f> mirrored;  // light that comes from there
    std::vector<char> lit;
    std::unique_ptr<bool[]> blocked;
    std::size_t blocked_size = 0;
  };

  /// `pixel_angle` [rad] is what one ray stands for. `reflections`: water mirrors bodies.
  Shader(const World& world, float pixel_angle, bool reflections);

  /// Radiance along each ray, linear RGB; unit as in Sky. `time` [s] moves the ripples.
  void shade(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count, double time,
             Scratch& scratch, Eigen::Vector3f* out) const;

  const Sky& sky() const { return sky_; }

 private:
  bool isWater(const Hit& hit) const { return hit.body == Hit::kGround && water_; }
  void castShadows(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count,
                   Scratch& scratch) const;
  void castMirrored(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count, double time,
                    Scratch& scratch) const;
  void lookAtWater(const Ray* rays, const Hit* hits, double time, Scratch& scratch) const;
  Eigen::Vector3f surface(const Ray& ray, const Hit& hit, bool lit) const;
  Eigen::Vector3f waterSurface(const Hit& hit, bool lit, const WaterLook& look,
                               const Eigen::Vector3f& mirrored) const;
  Eigen::Vector3f hazed(const Eigen::Vector3f& colour, float range) const;
  float footprint(const Ray& ray, const Hit& hit) const;

  Sky sky_;
  Ripples ripples_;
  bool water_, reflections_;
  float pixel_angle_;
  float visibility_;  // [m]
  Eigen::Vector3f bounce_, below_;  // light from the ground, and out of water
};

}  // namespace field_fusion::core::sim
