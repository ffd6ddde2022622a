#include "ray_cut.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core::sim {
namespace {

using Eigen::Vector3d;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr Span kMissed{kFar, -kFar};

/// Where |from + t along| < radius.
Span within(const Vector3d& from, const Vector3d& along, double radius) {
  const double a = along.squaredNorm();
  if (a < 1e-24) return from.norm() <= radius ? Span{-kFar, kFar} : kMissed;
  const double middle = -from.dot(along) / a;
  const double square = radius * radius - (from + middle * along).squaredNorm();
  if (square < 0.0) return kMissed;
  const double half = std::sqrt(square / a);
  return {middle - half, middle + half};
}

struct Solid {  // a cylinder in double precision
  Vector3d foot, unit;
  double length, radius;

  explicit Solid(const Cylinder& c)
      : foot(c.foot.cast<double>()), unit(c.axis.cast<double>()), length(unit.norm()), radius(c.radius) {
    unit /= length;
  }
  Vector3d across(const Vector3d& v) const { return v - unit.dot(v) * unit; }
};

Span between(double origin, double direction, double length) {
  if (direction == 0.0) return origin >= 0.0 && origin <= length ? Span{-kFar, kFar} : kMissed;
  const double a = -origin / direction, b = (length - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

struct Cutter {
  const Line& line;
  unsigned primitive;
  double t;

  Cut operator()(const Mesh& mesh) const {
    const auto& [i, j, k] = mesh.triangles[primitive];
    const Vector3d a = mesh.vertices[i].cast<double>();
    const Vector3d normal = (mesh.vertices[j].cast<double>() - a).cross(mesh.vertices[k].cast<double>() - a);
    const double exact = normal.dot(a - line.origin) / normal.dot(line.direction);
    return {std::isfinite(exact) && exact >= 0.0 ? exact : t, normal};
  }
  Cut operator()(const Sphere& sphere) const {
    const Span s = span(line, sphere);
    const double exact = s.enter <= s.leave ? s.nearest(t) : t;
    return {exact, line.at(exact) - sphere.centre.cast<double>()};
  }
  Cut operator()(const Cylinder& cylinder) const {
    const Span s = span(line, cylinder);
    const double exact = s.enter <= s.leave ? s.nearest(t) : t;
    const Solid solid(cylinder);
    const Vector3d p = line.at(exact) - solid.foot;
    const double along = solid.unit.dot(p);
    const Vector3d out = p - along * solid.unit;
    // depth under the side against the depth under the nearer end
    const double side = std::abs(solid.radius - out.norm()),
                 end = std::min(std::abs(along), std::abs(along - solid.length));
    if (side <= end) return {exact, out};
    return {exact, along > 0.5 * solid.length ? solid.unit : Vector3d(-solid.unit)};
  }
};

}  // namespace

Span span(const Line& line, const Sphere& sphere) {
  return within(line.origin - sphere.centre.cast<double>(), line.direction, sphere.radius);
}

Span span(const Line& line, const Cylinder& cylinder) {
  const Solid solid(cylinder);
  const Vector3d from = line.origin - solid.foot;
  const Span round = within(solid.across(from), solid.across(line.direction), solid.radius);
  const Span flat = between(solid.unit.dot(from), solid.unit.dot(line.direction), solid.length);
  return {std::max(round.enter, flat.enter), std::min(round.leave, flat.leave)};
}

Cut cut(const Line& line, const Shape& shape, unsigned primitive, double t) {
  return std::visit(Cutter{line, primitive, t}, shape);
}

}  // namespace field_fusion::core::sim
