#pragma once
// Cylinders as a geometry of Embree's users: none of its own is one.
#include <embree3/rtcore.h>

#include "field_fusion/core/sim/model.h"
#include "field_fusion/core/sim/lanes.h"

namespace field_fusion::core::sim {

/// `geometry` is of the type for users; its data is the Part, which holds a Cylinder.
void castAsCylinder(RTCGeometry geometry);

/// Draws well-mixed bits (the finaliser of MurmurHash3).
FIELD_FUSION_INLINE unsigned mix(unsigned h) {
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

/// Whether a part lets a ray pass at what it hits; `ray` is its number.
inline bool passes(const Part& part, unsigned ray, unsigned instance, unsigned geometry, unsigned primitive) {
  const unsigned drawn = mix(ray ^ mix(instance + mix(geometry + mix(primitive))));
  return static_cast<float>(drawn >> 8) < part.material.transparency * 16777216.f;
}

}  // namespace field_fusion::core::sim
