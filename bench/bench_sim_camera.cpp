// Pictures a second of the simulated colour camera with every fault on, beside a depth picture of the same
// size (one cast for each pixel), in a harbour with water, one core's work counted twice: rows share nothing.
#include "field_fusion/core/sim/colour_camera.h"
#include "figure.h"
#include "harbour.h"

namespace field_fusion::bench {
namespace {

using namespace core::sim;

void castDepth(const Caster& caster, const Lens& lens, const core::Transform& T_world_sensor) {
  const Eigen::Isometry3f T = (T_world_sensor * sensorToOptical()).cast<float>();
  static std::vector<Ray> rays;
  static std::vector<Hit> hits;
  rays.resize(static_cast<std::size_t>(lens.width())), hits.resize(rays.size());
  for (int v = 0; v < lens.height(); ++v) {
    for (int u = 0; u < lens.width(); ++u)
      rays[static_cast<std::size_t>(u)] = {T.translation(), T.linear() * lens.ray(u, v), 0.f};
    caster.cast(rays.data(), hits.data(), rays.size());
  }
}

std::vector<double> perSecond(std::vector<double> costs_ms) {
  constexpr double kCores = 2.0;
  for (double& c : costs_ms) c = kCores * 1e3 / c;
  return costs_ms;
}

void run() {
  const World world = Harbour::world();
  Caster caster(world);
  ColourCamera camera(CameraParams{}, world, 1);
  double time = 0.0;
  const auto pose = [](double t) {
    core::Transform T = core::Transform::Identity();
    T.translate(Eigen::Vector3d(0.5 * t, 0.0, 2.2));
    T.rotate(Eigen::AngleAxisd(0.1 + 0.2 * t, Eigen::Vector3d::UnitZ()));
    return T;
  };
  const auto colour = [&] { camera.run(caster, pose, time += 0.02); };
  const auto depth = [&] { castDepth(caster, camera.lens(), pose(time)); };
  constexpr int kRepeats = 25;
  print("sim/camera_640_colour", medianFigure(perSecond(costs(kRepeats, colour))), "frames/s");
  print("sim/camera_640", medianFigure(perSecond(costs(kRepeats, [&] { colour(), depth(); }))), "frames/s");
}

}  // namespace
}  // namespace field_fusion::bench

int main() { field_fusion::bench::run(); }
