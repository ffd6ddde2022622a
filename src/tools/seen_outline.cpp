// A simulated world -> the outlines in it, as seen from above, and what of them the robot could see on its way.
#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>

#include "field_fusion/core/sim/seen.h"
#include "field_fusion/ros/sim_run.h"

namespace {

using namespace field_fusion;
namespace sim = core::sim;

constexpr double kCell = 0.01, kEvery = 0.1;  // m, s
constexpr int kStep = 2;                      // [px] of an image

struct Options {
  std::string world, file;
  double seconds = 30.0, low = 0.05, high = 0.6, range = 5.0;
  int seed = 1;
};

struct Seen {
  sim::SeenCells camera, scanner;
};

/// One sensor at one time.
struct Look {
  const Options& options;
  const sim::Caster& caster;
  const sim::PoseTrack::Pose pose;
  Seen& seen;

  void operator()(const sim::DepthCameraParams& camera) const {
    const sim::SeenParams counts{options.low, options.high, camera.min_range,
                                 std::min(camera.max_range, options.range)};
    sim::addSeen(caster, sim::raysOf(camera, pose, kStep), counts, kCell, seen.camera);
  }
  void operator()(const sim::Scanner2dParams& scanner) const {
    const sim::SeenParams counts{-INFINITY, INFINITY, scanner.beam.min_range, scanner.beam.max_range};
    sim::addSeen(caster, sim::raysOf(scanner, pose), counts, kCell, seen.scanner);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

Seen walk(const sim::World& world, const std::string& sensors, const Options& options) {
  Seen seen;
  sim::Caster caster(world);
  std::vector<sim::SensorParams> kinds;
  for (const sim::Mount& mount : world.robot.mounts)
    kinds.push_back(sim::sensorParams(sensors, mount.model, mount.overrides));
  for (int i = 0; i * kEvery <= options.seconds; ++i) {
    const double time = i * kEvery;
    caster.setWindow(time, time);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto pose = [&](double t) { return world.robot.way.pose(t) * world.robot.mounts[k].T_base_sensor; };
      std::visit(Look{options, caster, sim::PoseTrack(pose, time, time).at(0.f), seen}, kinds[k]);
    }
  }
  return seen;
}

/// A cell that lies on a border counts as seen with either.
bool besideSeen(const sim::SeenCells& cells, const std::pair<int, int>& cell) {
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      if (cells.count({cell.first + dx, cell.second + dy}) > 0) return true;
  return false;
}

void write(const sim::TruthGrid& slice, const Seen& seen, const std::string& file) {
  std::ofstream out(file);
  const auto row = [&](const std::pair<int, int>& cell, bool outline, bool camera, bool scanner) {
    out << (cell.first + 0.5) * kCell << ',' << (cell.second + 0.5) * kCell << ',' << outline << ',' << camera << ','
        << scanner << '\n';
  };
  out << "x,y,outline,camera,scanner\n";
  const sim::SeenCells outline = sim::outlineOf(slice);
  for (int r = 0; r < slice.rows; ++r)
    for (int c = 0; c < slice.columns; ++c) {
      if (!slice.at(c, r)) continue;
      const std::pair cell(static_cast<int>(std::lround(slice.origin.x() / kCell)) + c,
                           static_cast<int>(std::lround(slice.origin.y() / kCell)) + r);
      const bool border = outline.count(cell) > 0;
      row(cell, border, border && besideSeen(seen.camera, cell), false);
    }
  for (const auto& cell : seen.scanner) row(cell, true, false, true);
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

void run(const Options& options) {
  const std::string file = worldFile(options.world), sensors = sensorsBeside(file);
  const sim::World world = sim::loadWorld(file, sensors, static_cast<std::uint64_t>(options.seed));
  sim::SliceParams slice;
  slice.low = options.low, slice.high = options.high, slice.cell = kCell;
  write(sim::occupancy(world, 0.0, slice), walk(world, sensors, options), options.file);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Writes, as CSV, cells of 1 cm: those of the bodies' surfaces between two heights (at the start), which of them are "
      "outline, which of these the depth camera could see on the robot's way, and where the 2-D scanner's beams end.");
  app.add_option("world", options.world, "file, or name of a world that comes with the package")->required();
  app.add_option("file", options.file, "CSV to write: x, y [m, world], outline, camera, scanner")->required();
  app.add_option("--seconds", options.seconds, "of the way")->capture_default_str()->check(CLI::Range(0.01, 1e5));
  app.add_option("--seed", options.seed, "of true mounts and sizes")->capture_default_str()->check(CLI::Range(0, 2147483647));
  app.add_option("--low", options.low, "[m] of the slice")->capture_default_str();
  app.add_option("--high", options.high, "[m] of the slice")->capture_default_str();
  app.add_option("--range", options.range, "[m] that counts of the camera's")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& e) {
    std::cerr << "seen_outline: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
