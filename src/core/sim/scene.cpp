#include "field_fusion/core/sim/scene.h"

#include <cmath>
#include <limits>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Stretch {  // of a ray
  double enter, leave;
};

/// Between the planes a and b of one axis; all or nothing where the ray runs along them.
Stretch within(double a, double b, double origin, double direction) {
  if (direction == 0.0)
    return origin >= a && origin <= b ? Stretch{-kNever, kNever} : Stretch{kNever, -kNever};
  const double ta = (a - origin) / direction, tb = (b - origin) / direction;
  return {std::min(ta, tb), std::max(ta, tb)};
}

Stretch withinCylinder(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) {
  const Eigen::Vector2d from = origin.head<2>() - box.center().head<2>(), along = direction.head<2>();
  const double radius = 0.5 * box.sizes().x();
  const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
  if (a == 0.0) return within(0.0, radius, from.norm(), 0.0);
  const double root = std::sqrt(b * b - a * c);  // NaN: the ray passes by
  return std::isnan(root) ? Stretch{kNever, -kNever} : Stretch{(-b - root) / a, (-b + root) / a};
}

Stretch overlap(Stretch a, Stretch b) { return {std::max(a.enter, b.enter), std::min(a.leave, b.leave)}; }

double rangeTo(const Body& body, double time, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
  const Eigen::AlignedBox3d box = body.boxAt(time);
  const auto axis = [&](int i) { return within(box.min()[i], box.max()[i], origin[i], direction[i]); };
  const Stretch flat =
      body.shape == Body::Shape::kBox ? overlap(axis(0), axis(1)) : withinCylinder(box, origin, direction);
  const Stretch all = overlap(flat, axis(2));
  return all.enter > 0.0 && all.enter <= all.leave ? all.enter : kNever;
}

}  // namespace

Eigen::AlignedBox3d Body::boxAt(double time) const {
  const Eigen::Vector2d at = middle + reach * std::sin(radians(360.0) * time / period);
  return {Eigen::Vector3d(at.x() - 0.5 * size.x(), at.y() - 0.5 * size.y(), 0.0),
          Eigen::Vector3d(at.x() + 0.5 * size.x(), at.y() + 0.5 * size.y(), size.z())};
}

Scene quayScene() {
  constexpr auto kBox = Body::Shape::kBox, kCylinder = Body::Shape::kCylinder;
  const Eigen::Vector3d person(0.5, 0.5, 1.75), car(4.3, 1.8, 1.5), bollard(0.4, 0.4, 0.8);
  const Eigen::Vector2d still(0, 0);
  return {{"person", kCylinder, person, {8, 2.5}, {0, 1.5}, 12, {60, 120, 230}},
          {"person", kCylinder, person, {12, -3}, {2, 0.5}, 16, {90, 190, 90}},
          {"person", kCylinder, person, {13, 5}, still, 10, {190, 120, 60}},
          {"car", kBox, car, {16, 0}, {3, 0}, 14, {50, 50, 200}},
          {"car", kBox, {1.8, 4.3, 1.5}, {14, -8}, still, 10, {200, 140, 40}},
          {"truck", kBox, {8, 2.5, 3.2}, {25, 6.5}, {3, 0}, 20, {200, 200, 205}},
          {"", kBox, {6, 2.4, 2.6}, {24, -11.5}, still, 10, {40, 110, 180}},  // container
          {"", kBox, {12, 2.4, 2.6}, {25, 14}, still, 10, {120, 120, 60}},    // container
          {"", kCylinder, bollard, {9, -5.5}, still, 10, {70, 70, 70}},
          {"", kCylinder, bollard, {9, 6.5}, still, 10, {70, 70, 70}},
          {"", kCylinder, {0.3, 0.3, 6}, {15, 8.5}, still, 10, {110, 110, 115}}};  // lamp post
}

Hit cast(const Scene& scene, double time, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Hit nearest{kNever, Hit::kNothing};
  const double down = -origin.z() / direction.z();
  if (down > 0.0 && std::isfinite(down)) nearest = {down, Hit::kGround};
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const double range = rangeTo(scene[i], time, origin, direction);
    if (range < nearest.range) nearest = {range, static_cast<int>(i)};
  }
  return nearest;
}

}  // namespace field_fusion::core
