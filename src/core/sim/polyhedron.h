#pragma once
// Any shape as triangles, where facets do no harm.
#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

/// The triangles of a mesh; inscribed ones, 64 to a turn, for what is round.
Mesh polyhedron(const Shape& shape);

}  // namespace field_fusion::core::sim
