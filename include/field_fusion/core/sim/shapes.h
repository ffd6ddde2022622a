#pragma once
// The library of bodies: functions that make a model from a few numbers, known by name.
//
// Sizes: `length` is the extent along x, `width` along y, `height` the top above z = 0, `diameter` the extent
// along x and y. A body stands on z = 0; one with a `draught` floats: z = 0 is the water and the draught is
// how deep it reaches.
#include <map>
#include <string>

#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

/// Metres and degrees (names that end in _deg).
using ShapeParams = std::map<std::string, double>;

struct ShapeKind {
  const char* text;      ///< what it is
  ShapeParams defaults;  ///< every parameter that it has
  Model (*make)(const ShapeParams&);
};

const std::map<std::string, ShapeKind>& shapeKinds();

/// Throws std::invalid_argument naming an unknown shape or parameter (with those there are), and a size that
/// is not above 0.
Model makeShape(const std::string& name, const ShapeParams& params = {});

/// docs/shapes.md: every shape with its parameters and the parts that a world can paint.
std::string shapesDocument();

/// All triangles of a file that assimp reads (OBJ, PLY, DAE, STL), `scale` times as large. Throws
/// std::runtime_error naming the file if it cannot be read or has no triangles.
Mesh loadMesh(const std::string& file, double scale = 1.0);

}  // namespace field_fusion::core::sim
