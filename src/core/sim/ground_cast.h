#pragma once
// Rays against the ground, eight at a time: plane and water by formula, a rough one as a mesh of its heights.
#include "water_cast.h"

namespace field_fusion::core::sim {

/// Plane or water; no ray meets the others.
class GroundCast {
 public:
  explicit GroundCast(const Ground& ground) : ground_(ground), water_(ground.waves) {}

  void bounds(const LineLanes& lines, BoundLanes& out) const;
  /// Where those lines that are `wanted` (1, not 0) first meet it.
  void meet(const LineLanes& lines, const Lanes<double>& wanted, MeetingLanes& out) const;

 private:
  void meetPlane(const LineLanes& lines, MeetingLanes& out) const;

  const Ground& ground_;
  WaterCast water_;
};

/// Heights of a rough ground on a square grid, an eighth of its grain apart or the extent / 768.
Mesh roughMesh(const Ground& ground);

}  // namespace field_fusion::core::sim
