#pragma once
// Light of the sky. Unit of all light: the radiance of a white sheet that faces a sun of brightness 1.
#include <vector>

#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

class Sky {
 public:
  explicit Sky(const Light& light);

  /// Radiance from a direction (unit vector): gradient, clouds, brightness about the sun, without its disc.
  Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
  /// With its disc, half a degree wide.
  Eigen::Vector3f withSun(const Eigen::Vector3f& direction) const;
  Eigen::Vector3f haze() const { return horizon_; }
  /// Radiance of a white matt sheet with this normal in the light of sky and `bounce` from below.
  Eigen::Vector3f ambient(const Eigen::Vector3f& normal, const Eigen::Vector3f& bounce) const;
  /// The same for a sheet that faces the sun.
  const Eigen::Vector3f& sun() const { return sun_; }
  const Eigen::Vector3f& toSun() const { return to_sun_; }

 private:
  static constexpr int kSide = 512;

  float clouds(const Eigen::Vector3f& direction) const;

  Eigen::Vector3f to_sun_, sun_, ambient_, zenith_, horizon_;
  std::vector<float> clouds_;  // kSide x kSide, upper half of the sky in stereographic projection
};

}  // namespace field_fusion::core::sim
