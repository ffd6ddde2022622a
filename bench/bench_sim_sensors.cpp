// Beams and depth frames of the simulator a second, with every fault on, where the papers' robots stand.
#include "field_fusion/core/sim/sensor_models.h"
#include "figure.h"

namespace {

using namespace field_fusion;
using namespace field_fusion::core::sim;

constexpr int kRepeats = 41;
const std::string kConfig = PROJECT_DIR "/config/";

/// A world, and one sensor of its robot on its way.
struct Bench {
  World world;
  Mount mount;
  Caster caster;
  PoseAt pose;

  Bench(const std::string& name, const std::string& sensor)
      : world(loadWorld(kConfig + "worlds/" + name + ".yaml")), mount(mountOf(sensor)), caster(world) {
    pose = [this](double time) { return world.robot.way.pose(time) * mount.T_base_sensor; };
  }
  Mount mountOf(const std::string& sensor) const {
    for (const Mount& m : world.robot.mounts)
      if (m.name == sensor) return m;
    throw std::runtime_error("no sensor " + sensor + " in " + world.name);
  }
};

template <class Lidar>
void measureBeams(Bench& bench, Lidar& lidar, const std::string& name, int beams) {
  std::vector<double> rates;
  double time = 0.0, returns = 0.0, mixed = 0.0;
  const auto scan = [&] {
    lidar.scan(bench.caster, bench.pose, time);
    time += 1.0 / lidar.params().rate;
    for (const BeamReturn& r : lidar.truth()) returns += r.body != Hit::kNothing, mixed += r.mixed;
  };
  for (const double ms : bench::costs(kRepeats, scan)) rates.push_back(1e-3 * beams / ms);
  std::printf("%s: %d beams a scan, %.0f returns, %.1f %% of them mixed\n", name.c_str(), beams,
              returns / (kRepeats + 1), 100.0 * mixed / returns);
  bench::print("sim/beams/" + name, bench::medianFigure(rates), "million/s");
}

/// Of one thread, whose CPU time it is. Faults that the model's file leaves out are on too.
void beams(const std::string& name, const std::string& mount, const std::string& model) {
  Bench bench(name, mount);
  const std::string other = model.empty() ? bench.mount.model : model;
  const Overrides faults = {{"threads", "1"},
                            {"fault_rate", "0.001"},
                            {"range_noise_weak", "0.01"},
                            {"range_scale", "0.001"},
                            {"angle_noise", "0.02"}};
  const SensorParams params = sensorParams(kConfig + "sensors", other, faults);
  if (const auto* flat = std::get_if<Scanner2dParams>(&params)) {
    Scanner2d scanner(*flat, 1);
    measureBeams(bench, scanner, name + "/" + other, flat->steps());
  } else {
    const auto& deep = std::get<Lidar3dParams>(params);
    Lidar3d lidar(deep, 1);
    measureBeams(bench, lidar, name + "/" + other, deep.columns() * static_cast<int>(deep.elevations.size()));
  }
}

/// By the clock on the wall, because the frame is shared by threads.
void frames(const std::string& name, const std::string& mount, int threads) {
  Bench bench(name, mount);
  const Overrides shared = {{"threads", std::to_string(threads)}};
  DepthCamera camera(
      std::get<DepthCameraParams>(sensorParams(kConfig + "sensors", bench.mount.model, shared)), 1);
  std::vector<double> rates;
  for (int i = 0; i < kRepeats; ++i) {
    rates.push_back(1e3 / bench::wallMs([&] { camera.frame(bench.caster, bench.pose, i / camera.params().rate); }));
  }
  bench::print("sim/depth_frames/" + name + "/" + std::to_string(threads) + "_threads",
               bench::medianFigure(rates), "1/s");
}

}  // namespace

int main() {
  beams("usv_cages", "lidar", "");
  beams("usv_cages", "lidar", "hdl64");
  beams("quad_lab", "scan", "");
  beams("quad_lab", "scan", "lms141");
  beams("quad_lab", "scan", "vlp16");
  frames("quad_lab", "depth", 1);
  frames("quad_lab", "depth", 2);
  return 0;
}
