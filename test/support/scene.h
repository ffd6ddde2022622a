#pragma once
// A small analytic world for clouds that tests know all about: boxes and upright cylinders on the plane z =
// 0.
#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <vector>

namespace field_fusion::test {

struct Body {
  enum class Shape { kBox, kCylinder };

  Shape shape = Shape::kBox;
  Eigen::Vector3d size{1, 1, 1};  ///< [m] along x, y, z; a cylinder is size.x wide
  Eigen::Vector2d middle{0, 0};   ///< [m]

  Eigen::AlignedBox3d box() const {
    const Eigen::Vector2d half = 0.5 * size.head<2>();
    return {Eigen::Vector3d(middle.x() - half.x(), middle.y() - half.y(), 0.0),
            Eigen::Vector3d(middle.x() + half.x(), middle.y() + half.y(), size.z())};
  }
};

using Scene = std::vector<Body>;

struct Hit {
  static constexpr int kNothing = -2, kGround = -1;
  double range;         ///< [m] along the ray; infinite for kNothing
  int body = kNothing;  ///< place in the scene
};

namespace detail {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Stretch {  // of a ray
  double enter, leave;
};

/// Between the planes a and b of one axis; all or nothing where the ray runs along them.
inline Stretch within(double a, double b, double origin, double direction) {
  if (direction == 0.0)
    return origin >= a && origin <= b ? Stretch{-kNever, kNever} : Stretch{kNever, -kNever};
  const double ta = (a - origin) / direction, tb = (b - origin) / direction;
  return {std::min(ta, tb), std::max(ta, tb)};
}

inline Stretch withinCylinder(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& direction) {
  const Eigen::Vector2d from = origin.head<2>() - box.center().head<2>(), along = direction.head<2>();
  const double radius = 0.5 * box.sizes().x();
  const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
  if (a == 0.0) return within(0.0, radius, from.norm(), 0.0);
  const double root = std::sqrt(b * b - a * c);  // NaN: the ray passes by
  return std::isnan(root) ? Stretch{kNever, -kNever} : Stretch{(-b - root) / a, (-b + root) / a};
}

inline Stretch overlap(Stretch a, Stretch b) {
  return {std::max(a.enter, b.enter), std::min(a.leave, b.leave)};
}

inline double rangeTo(const Body& body, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::AlignedBox3d box = body.box();
  const auto axis = [&](int i) { return within(box.min()[i], box.max()[i], origin[i], direction[i]); };
  const Stretch flat =
      body.shape == Body::Shape::kBox ? overlap(axis(0), axis(1)) : withinCylinder(box, origin, direction);
  const Stretch all = overlap(flat, axis(2));
  return all.enter > 0.0 && all.enter <= all.leave ? all.enter : kNever;
}

}  // namespace detail

/// The first surface along a ray from `origin` in the unit `direction`. A body that holds the origin is not
/// seen.
inline Hit cast(const Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Hit nearest{detail::kNever, Hit::kNothing};
  const double down = -origin.z() / direction.z();
  if (down > 0.0 && std::isfinite(down)) nearest = {down, Hit::kGround};
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const double range = detail::rangeTo(scene[i], origin, direction);
    if (range < nearest.range) nearest = {range, static_cast<int>(i)};
  }
  return nearest;
}

}  // namespace field_fusion::test
