// Casts of the simulator a second on one core, for rays as a spinning LiDAR sends them.
#include <cmath>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/shapes.h"
#include "figure.h"

namespace {

using namespace field_fusion;
using namespace field_fusion::core::sim;

constexpr int kRepeats = 21;

void put(World& world, const char* shape, double x, double y, double yaw, const ShapeParams& params = {},
         const Trajectory::Limits* walks = nullptr) {
  Body body;
  body.name = shape + std::to_string(world.bodies.size());
  body.model = makeShape(shape, params);
  body.way = walks ? Trajectory({{{x, y, 0}, core::kNaN, 0}, {{x + 20, y, 0}, core::kNaN, 0}}, *walks)
                   : Trajectory({{{x, y, 0}, yaw, 0}}, {});
  world.bodies.push_back(std::move(body));
}

/// Ten cages, boats and buoys on waves.
World cages() {
  World world;
  world.ground.kind = Ground::Kind::kWater;
  world.ground.waves = {{0.1, 9, 0.3, 0.1}, {0.05, 5, -0.5, 2}, {0.03, 2.5, 1.2, 4}};
  for (int i = 0; i < 10; ++i) {
    const double angle = core::radians(-60 + 13 * i), range = 2.0 + 0.5 * (i % 7);
    put(world, "cage", range * std::cos(angle), range * std::sin(angle), 0.0);
  }
  for (int i = 0; i < 5; ++i) put(world, i % 2 ? "boat" : "buoy", -6.0 - 3 * i, 5.0 * i - 10, 0.4 * i);
  return world;
}

/// A closed room with furniture and obstacles, two people walking.
World room() {
  World world;
  for (const double y : {-6.0, 6.0}) put(world, "wall", 0, y, 0, {{"length", 16}});
  for (const double x : {-8.0, 8.0}) put(world, "wall", x, 0, core::radians(90), {{"length", 12}});
  const char* things[] = {"chair",       "stool",   "radiator",         "cardboard_box",
                          "blue_cone",   "barrel",  "distribution_box", "bench",
                          "ladder_back", "football"};
  for (int i = 0; i < 30; ++i)
    put(world, things[i % 10], -7.0 + 0.5 * i, i % 2 ? 4.5 : -4.5 + 0.1 * i, 0.7 * i);
  put(world, "experimental_table", 0, 2, 0);
  Trajectory::Limits walk;
  walk.speed = 1.3;
  for (const double y : {-2.0, -3.0}) put(world, "person", -6, y, 0, {{"speed", 1.3}}, &walk);
  return world;
}

/// Sixteen rings of 1800 rays from 0.9 m above the ground, as one turn goes, in blocks along a ring.
std::vector<Ray> turn() {
  std::vector<Ray> rays;
  for (int ring = 0; ring < 16; ++ring)
    for (int i = 0; i < 1800; ++i) {
      const double azimuth = core::radians(0.2 * i), up = core::radians(-15.0 + 2.0 * ring);
      const Eigen::Vector3d along(std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth),
                                  std::sin(up));
      rays.push_back({{0, 0, 0.9f}, along.cast<float>(), static_cast<float>(i) / 1800.f});
    }
  return rays;
}

void measure(const std::string& name, const World& world) {
  Caster caster(world);
  const std::vector<Ray> rays = turn();
  std::vector<Hit> hits(rays.size());
  double time = 0.0;
  const auto window = bench::costs(kRepeats, [&] { caster.setWindow(time, time + 0.1), time += 0.1; });
  std::vector<double> rates;
  for (const double ms : bench::costs(kRepeats, [&] { caster.cast(rays.data(), hits.data(), rays.size()); }))
    rates.push_back(1e-3 * static_cast<double>(rays.size()) / ms);
  std::size_t bodies = 0, ground = 0;
  for (const Hit& hit : hits) bodies += hit.body >= 0, ground += hit.body == Hit::kGround;
  std::printf("%s: of %zu rays %zu met bodies, %zu the ground\n", name.c_str(), rays.size(), bodies, ground);
  bench::print("sim/casts/" + name, bench::medianFigure(rates), "million/s");
  bench::print("sim/window/" + name, bench::medianFigure(window), "ms");
}

/// What it costs to move 100 bodies.
World crowd() {
  World world;
  Trajectory::Limits walk;
  for (int i = 0; i < 100; ++i) put(world, "cardboard_box", 3 * (i % 10), 3 * (i / 10), 0, {}, &walk);
  return world;
}

}  // namespace

int main() {
  measure("cages", cages());
  measure("room", room());
  measure("hundred_moving", crowd());
  return 0;
}
