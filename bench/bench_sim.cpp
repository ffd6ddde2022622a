// Casts of the simulator a second on one core, for rays as a spinning LiDAR sends them.
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/shapes.h"
#include "figure.h"

namespace {

using namespace field_fusion;
using namespace field_fusion::core::sim;

constexpr int kRepeats = 21;

/// Sixteen rings of 1800 rays, a ring after the other, as one turn of a LiDAR goes.
std::vector<Ray> turn(const Eigen::Vector3d& from) {
  std::vector<Ray> rays;
  for (int ring = 0; ring < 16; ++ring)
    for (int i = 0; i < 1800; ++i) {
      const double azimuth = core::radians(0.2 * i), up = core::radians(-15.0 + 2.0 * ring);
      const Eigen::Vector3d along = core::cartesian({1.0, azimuth, up});
      rays.push_back({from.cast<float>(), along.cast<float>(), static_cast<float>(i) / 1800.f});
    }
  return rays;
}

/// From where the robot's first sensor starts.
void measure(const std::string& name, const World& world) {
  Caster caster(world);
  Eigen::Vector3d eye(0, 0, 1);
  if (!world.robot.mounts.empty()) eye = world.robot.mounts[0].T_base_sensor.translation();
  const std::vector<Ray> rays = turn(world.robot.way.pose(0.0) * eye);
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

/// Boxes that all move.
World hundredMoving() {
  World world;
  for (int i = 0; i < 100; ++i) {
    const double x = 3 * (i % 10), y = 3 * (i / 10);
    Body body;
    body.model = makeShape("cardboard_box");
    body.way = Trajectory({{{x, y, 0}, core::kNaN, 0}, {{x + 20, y, 0}, core::kNaN, 0}}, {});
    world.bodies.push_back(std::move(body));
  }
  return world;
}

}  // namespace

int main() {
  for (const std::string name : {"usv_cages", "usv_harbour", "quad_lab"})
    measure(name, loadWorld(PROJECT_DIR "/config/worlds/" + name + ".yaml"));
  measure("hundred_moving", hundredMoving());
  return 0;
}
