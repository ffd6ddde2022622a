#pragma once
// Where a ray cuts one surface, in double precision: Embree finds which surface is first, this where exactly.
#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

struct Line {
  Eigen::Vector3d origin, direction;

  Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

struct Cut {
  double t;
  Eigen::Vector3d normal;  ///< outwards; not of unit length
};

/// The two places where a line enters and leaves a convex body; none: enter > leave.
struct Span {
  double enter, leave;

  double nearest(double t) const { return std::abs(enter - t) <= std::abs(leave - t) ? enter : leave; }
};

Span span(const Line& line, const Sphere& sphere);
Span span(const Line& line, const Cylinder& cylinder);

/// The cut with what Embree found at about `t`: triangle `primitive` of a mesh, or the surface of a solid.
Cut cut(const Line& line, const Shape& shape, unsigned primitive, double t);

}  // namespace field_fusion::core::sim
