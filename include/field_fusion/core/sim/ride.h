#pragma once
// How a body follows the ground it is on.
#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

/// A body's way gives x, y, yaw and its height over the ground; the ground gives the rest.
enum class Ride {
  kUpright,  ///< feet on the ground below its origin, never leaning: people, trees
  kLeaning,  ///< on the ground below its footprint: vehicles, animals
  kFloating  ///< the same on water, at any time
};

/// `length` and `width` [m] of the footprint, about the body's origin. Heave is the mean height of the ground
/// over it, roll and pitch are those of the plane that fits it best, so waves shorter than the body move it
/// little. Where there is no ground, and over water unless it floats, the body stays where its way is.
Trajectory carriedByGround(const Trajectory& way, const Ground& ground, Ride ride, double length,
                           double width);

}  // namespace field_fusion::core::sim
