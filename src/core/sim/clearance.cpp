#include <algorithm>

#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kStep = 0.05;          // [s] between the places of the way that are looked at
constexpr std::size_t kMost = 2000;     // of them

/// A body with what tells quickly that a point is not in it.
struct Obstructing {
  explicit Obstructing(const Body& of) : body(&of), box(of.model.box()) {
    box.min().array() -= kMargin;
    box.max().array() += kMargin;
    if (of.way.still()) T_body_world = of.way.pose(0).inverse();
  }

  bool holds(const Eigen::Vector3d& place, double time) const {
    const Transform T = T_body_world ? *T_body_world : body->way.pose(time).inverse();
    const Eigen::Vector3d p = T * place;
    return box.contains(p) && inside(body->model, p, time);
  }

  static constexpr double kMargin = 0.1;  // [m] that joints may swing out of the box
  const Body* body;
  Eigen::AlignedBox3d box;
  std::optional<Transform> T_body_world;
};

}  // namespace

std::optional<Touch> firstTouch(const World& world, const std::vector<Eigen::Vector3d>& places) {
  std::vector<Obstructing> bodies;
  for (const Body& body : world.bodies)
    if (!body.model.links.empty()) bodies.emplace_back(body);
  const double end = world.robot.way.duration(), step = std::max(kStep, end / kMost);
  for (double time = 0.0; time <= end; time += step) {
    const Transform T_world_base = world.robot.way.pose(time);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const Obstructing& each : bodies)
        if (each.holds(T_world_base * places[i], time)) return Touch{i, each.body, time};
  }
  return std::nullopt;
}

}  // namespace field_fusion::core::sim
