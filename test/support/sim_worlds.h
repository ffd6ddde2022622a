#pragma once
// Worlds of a few flat walls, whose ranges follow from a line of algebra.
#include <limits>
#include <vector>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/pose_track.h"

namespace field_fusion::test {

using core::sim::Body;
using core::sim::Material;
using core::sim::World;

inline Material matt(float reflectivity) {
  Material material;
  material.reflectivity = reflectivity;
  return material;
}

/// A thin wall across x at `distance`, from y `right` to `left` [m], 200 m high about z = 0.
inline Body wallAhead(const char* name, float distance, float right, float left, const Material& material) {
  core::sim::Mesh mesh;
  mesh.vertices = {
      {distance, right, -100.f}, {distance, left, -100.f}, {distance, left, 100.f}, {distance, right, 100.f}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  Body body;
  body.name = name;
  body.model.links.push_back({{{mesh, material}}, {}});
  return body;
}

inline World worldOf(std::vector<Body> bodies) {
  World world;
  world.bodies = std::move(bodies);
  world.ground.kind = core::sim::Ground::Kind::kNone;
  return world;
}

/// Stands at the origin, turned by `yaw` [rad].
inline core::sim::PoseAt standing(double yaw = 0.0) {
  return [yaw](double) { return core::Transform(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())); };
}

/// Turns about z at the origin with `rate` [rad/s], looking along x at time 0.
inline core::sim::PoseAt turning(double rate) {
  return [rate](double time) {
    return core::Transform(Eigen::AngleAxisd(rate * time, Eigen::Vector3d::UnitZ()));
  };
}

/// Mean and standard deviation of what is finite.
struct Spread {
  double mean = 0.0, sigma = 0.0;
  std::size_t count = 0;
};

template <class Values>
Spread spreadOf(const Values& values) {
  Spread out;
  double sum = 0.0, squares = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) sum += v, ++out.count;
  out.mean = sum / static_cast<double>(out.count);
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - out.mean) * (v - out.mean);
  out.sigma = std::sqrt(squares / static_cast<double>(out.count));
  return out;
}

}  // namespace field_fusion::test
