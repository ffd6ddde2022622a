#pragma once
// The parts of the library of shapes.
#include "field_fusion/core/sim/shapes.h"

namespace field_fusion::core::sim {

using ShapeKinds = std::map<std::string, ShapeKind>;

ShapeKinds plainShapes();
ShapeKinds obstacleShapes();
ShapeKinds furnitureShapes();
ShapeKinds streetShapes();
ShapeKinds vehicleShapes();
ShapeKinds chairShapes();
ShapeKinds stoolShapes();
ShapeKinds boxShapes();
ShapeKinds boardShapes();
ShapeKinds inflatedShapes();
ShapeKinds marineShapes();
ShapeKinds cageShapes();
ShapeKinds boatShapes();
ShapeKinds buoyShapes();
ShapeKinds bollardShapes();
ShapeKinds personShapes();

}  // namespace field_fusion::core::sim
