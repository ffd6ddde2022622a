#pragma once
// Small worlds for the tests of the simulator.
#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim::test {

inline Trajectory still(const Eigen::Vector3d& at, double yaw = 0.0) {
  return Trajectory({{at, yaw, 0.0}}, {});
}

inline Body bodyOf(Shape shape, Trajectory way = {}) {
  Body body;
  body.name = "thing";
  body.model.links.push_back({{{std::move(shape), {}}}, {}, -1});
  body.way = std::move(way);
  return body;
}

/// One body and no ground.
inline World worldOf(Shape shape, Trajectory way = {}) {
  World world;
  world.ground.kind = Ground::Kind::kNone;
  world.bodies.push_back(bodyOf(std::move(shape), std::move(way)));
  return world;
}

/// Stands on z = 0 about the z axis.
inline Mesh boxMesh(const Eigen::Vector3f& size) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        size.cwiseProduct(Eigen::Vector3f(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 1.f : 0.f)));
  for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({a, c, d});
  return mesh;
}

}  // namespace field_fusion::core::sim::test
