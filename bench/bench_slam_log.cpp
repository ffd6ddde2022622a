// Grid SLAM on a CARMEN log with known relations (Kuemmerle et al. 2009), several seeds.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>

#include "field_fusion/core/io/carmen.h"
#include "field_fusion/core/io/relations.h"
#include "field_fusion/core/map/grid_slam.h"
#include "figure.h"

namespace {

using namespace field_fusion;

struct Options {
  std::string log, relations, name = "log", poses;
  double ahead = 0.0;  // [m] of the scanner before the odometry's centre
  int seeds = 5;
  std::vector<std::string> set;  // NAME=VALUE
  core::GridSlamParams params;
};

void set(core::GridSlamParams& params, const std::string& text) {
  const std::size_t at = text.find('=');
  const core::Params declared = core::declarationOf(params);
  const core::Param* param = declared.find(text.substr(0, at));
  if (!param || at == std::string::npos) throw std::invalid_argument(text + " sets no parameter");
  const double value = std::stod(text.substr(at + 1));
  if (std::holds_alternative<int>(param->get()))
    param->set(static_cast<int>(value));
  else
    param->set(value);
}

core::SlamScan scanOf(const core::CarmenScan& scan, const Options& o) {
  core::Transform T_base_sensor = core::Transform::Identity();
  T_base_sensor.translation().x() = o.ahead;
  return core::slamScan(scan.ranges, scan.angle_min, scan.angle_increment, T_base_sensor,
                        {o.params.min_range, o.params.usable_range, o.params.max_range});
}

/// Poses of the scanner.
std::vector<core::StampedPose2> run(const core::CarmenLog& log, const Options& o, std::vector<double>& cost) {
  core::GridSlam slam(o.params);
  double neff = 0;
  for (const core::CarmenScan& scan : log.scans) {
    const core::SlamScan points = scanOf(scan, o);
    const double ms = bench::costMs([&] { slam.process(points, scan.odometry, scan.stamp_ns); });
    cost.push_back(ms);
    neff += slam.effective();
  }
  auto path = core::pathTo(slam.best().path.get());
  for (core::StampedPose2& p : path) p.pose = p.pose * core::Pose2{o.ahead, 0.0, 0.0};
  std::printf("mean N_eff %.1f\n", neff / log.scans.size());
  return path;
}

void score(Options o) {
  const core::CarmenLog log = core::readCarmen(o.log);
  const auto relations = core::readRelations(o.relations);
  std::vector<double> translation, rotation, cost;
  for (int seed = 1; seed <= o.seeds; ++seed) {
    o.params.seed = seed;
    const auto path = run(log, o, cost);
    if (!o.poses.empty()) {
      std::ofstream out(o.poses + std::to_string(seed));
      for (const auto& p : path) out << std::to_string(p.stamp_ns / 1000 * 1e-6) << " " << p.pose.x << " " << p.pose.y << " " << p.pose.yaw << "\n";
    }
    const core::RelationScore s = core::scoreRelations(path, relations);
    translation.push_back(s.absoluteTranslation().mean), rotation.push_back(core::degrees(s.absoluteRotation().mean));
    auto sorted = s.translation;
    std::sort(sorted.begin(), sorted.end());
    std::printf("seed %d: %zu relations, %zu missing: %.4f +- %.4f m (median %.4f, without the worst %.4f), %.3f +- %.3f deg\n",
                seed, s.translation.size(), s.missing, translation.back(), s.absoluteTranslation().deviation,
                bench::median(s.translation), (translation.back() * sorted.size() - sorted.back()) / (sorted.size() - 1),
                rotation.back(), core::degrees(s.absoluteRotation().deviation));
  }
  double t = 0, r = 0;
  for (std::size_t i = 0; i < translation.size(); ++i) t += translation[i] / translation.size(), r += rotation[i] / rotation.size();
  std::printf("figure slam/%s/translation_mean %.4f m\nfigure slam/%s/translation_worst %.4f m\nfigure slam/%s/rotation_mean %.3f deg\n",
              o.name.c_str(), t, o.name.c_str(), *std::max_element(translation.begin(), translation.end()), o.name.c_str(), r);
  bench::print("slam/" + o.name + "/cost", bench::medianFigure(cost), "ms");
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  o.params.usable_range = 40.0, o.params.max_range = 80.0;
  o.params.linear_update = 0.0, o.params.angular_update = 0.0;
  o.params.threads = 1;
  CLI::App app("Runs the grid SLAM on a CARMEN log and scores the best path by relations.");
  app.add_option("log", o.log)->required();
  app.add_option("relations", o.relations)->required();
  app.add_option("--name", o.name);
  app.add_option("--poses", o.poses);
  app.add_option("--ahead", o.ahead, "[m] of the scanner before the odometry's centre");
  app.add_option("--seeds", o.seeds);
  app.add_option("--set", o.set, "NAME=VALUE of parameters");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const auto& s : o.set) set(o.params, s);
    score(o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_slam_log: %s\n", e.what());
    return 1;
  }
  return 0;
}
