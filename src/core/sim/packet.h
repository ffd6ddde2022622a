#pragma once
// Eight rays as Embree and the ground take them.
#include <embree3/rtcore.h>

#include "field_fusion/core/sim/caster.h"
#include "water_cast.h"

namespace field_fusion::core::sim {

struct Packet {
  alignas(32) int valid[kLanes];  ///< -1: a ray that Embree may cast; 0: none, or one that is not finite
  RTCRayHit8 rays;                ///< each to the end of the world; none has hit anything

  /// `count` of 1 to 8. Whether a surface with a transparency lets a ray pass is drawn from the ray's number
  /// (RTCRay::id) and the surface, so that the same ray always meets the same fate, in any packet and thread:
  /// the number comes from the bits of origin and direction alone. Without such surfaces it need not be
  /// `numbered`.
  Packet(const Ray* rays, std::size_t count, bool numbered);

  bool met(std::size_t lane) const { return rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }
  /// In double precision, at times that go from `begin` on over `length` [s].
  void lines(double begin, double length, LineLanes& out) const;
  RTCRayHit single(std::size_t lane) const;
};

}  // namespace field_fusion::core::sim
