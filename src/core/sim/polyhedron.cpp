#include "polyhedron.h"

#include <cmath>

namespace field_fusion::core::sim {
namespace {

constexpr std::uint32_t kTurn = 64;

/// Skin over rings of kTurn points each, one after the other.
Mesh skin(std::vector<Eigen::Vector3f> points) {
  Mesh mesh;
  const auto rings = static_cast<std::uint32_t>(points.size()) / kTurn;
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t i = 0; i < kTurn; ++i) {
      const std::uint32_t a = ring * kTurn + i, b = ring * kTurn + (i + 1) % kTurn;
      mesh.triangles.push_back({a, b, b + kTurn});
      mesh.triangles.push_back({a, b + kTurn, a + kTurn});
    }
  mesh.vertices = std::move(points);
  return mesh;
}

struct Rings {
  Eigen::Vector3f u, v;
  std::vector<Eigen::Vector3f> points;

  void add(const Eigen::Vector3f& middle, float radius) {
    for (std::uint32_t i = 0; i < kTurn; ++i) {
      const float angle = static_cast<float>(radians(360.0 * i / kTurn));
      points.push_back(middle + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
};

struct Facets {
  Mesh operator()(const Mesh& mesh) const { return mesh; }
  Mesh operator()(const Sphere& s) const {
    Rings rings{Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(), {}};
    for (std::uint32_t i = 0; i <= kTurn / 2; ++i) {
      const float polar = static_cast<float>(radians(-90.0 + 360.0 * i / kTurn));
      rings.add(s.centre + s.radius * std::sin(polar) * Eigen::Vector3f::UnitZ(), s.radius * std::cos(polar));
    }
    return skin(std::move(rings.points));
  }
  Mesh operator()(const Cylinder& c) const {
    const Eigen::Vector3f u = c.axis.unitOrthogonal();
    Rings rings{u, c.axis.normalized().cross(u), {}};
    const Eigen::Vector3f top = c.foot + c.axis;
    rings.add(c.foot, 0.f), rings.add(c.foot, c.radius);  // the ends are closed
    rings.add(top, c.radius), rings.add(top, 0.f);
    return skin(std::move(rings.points));
  }
};

}  // namespace

Mesh polyhedron(const Shape& shape) { return std::visit(Facets{}, shape); }

}  // namespace field_fusion::core::sim
