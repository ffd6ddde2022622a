// Grid SLAM on a CARMEN log with known relations (Kuemmerle et al. 2009), several seeds.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <numeric>

#include "field_fusion/core/io/carmen.h"
#include "field_fusion/core/io/relations.h"
#include "slam_run.h"

namespace {

using namespace field_fusion;

struct Options {
  std::string log, relations, name = "log", poses;
  double ahead = 0.0;  // [m] of the scanner before the odometry's centre
  int seeds = 5;
  core::GridSlamParams params;
};

std::vector<bench::LogScan> readLog(const Options& o) {
  core::Transform T_base_sensor = core::Transform::Identity();
  T_base_sensor.translation().x() = o.ahead;
  std::vector<bench::LogScan> out;
  for (const core::CarmenScan& s : core::readCarmen(o.log).scans)
    out.push_back({s.stamp_ns,
                   core::slamScan(core::scanOf(s, o.params.max_range), T_base_sensor,
                                  {o.params.min_range, o.params.usable_range, o.params.max_range}),
                   s.odometry});
  return out;
}

void writePoses(const std::string& file, const std::vector<core::StampedPose2>& poses) {
  std::ofstream out(file);
  for (const core::StampedPose2& p : poses)
    out << p.stamp_ns / 1'000'000'000 << "." << std::to_string(1'000'000'000 + p.stamp_ns % 1'000'000'000).substr(1)
        << " " << p.pose.x << " " << p.pose.y << " " << p.pose.yaw << "\n";
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void report(int seed, const bench::SlamRun& run, const core::RelationScore& s) {
  const double all = s.absoluteTranslation().mean, n = static_cast<double>(s.translation.size());
  const double worst = *std::max_element(s.translation.begin(), s.translation.end());
  std::printf(
      "seed %d: %zu scans, N_eff %.1f; %zu relations, %zu missing: %.4f +- %.4f m (median %.4f, without the worst "
      "%.4f), %.3f +- %.3f deg\n",
      seed, run.cost_ms.size(), run.effective, s.translation.size(), s.missing, all,
      s.absoluteTranslation().deviation, bench::median(s.translation), (all * n - worst) / (n - 1.0),
      core::degrees(s.absoluteRotation().mean), core::degrees(s.absoluteRotation().deviation));
}

void score(Options& o) {
  const auto log = readLog(o);
  const auto relations = core::readRelations(o.relations);
  const double before = bench::residentMb();  // the log is the benchmark's
  std::vector<double> translation, rotation, cost;
  for (int seed = 1; seed <= o.seeds; ++seed) {
    o.params.seed = seed;
    core::GridSlam slam(o.params);
    bench::SlamRun run = bench::runSlam(slam, log);
    for (core::StampedPose2& p : run.poses) p.pose = p.pose * core::Pose2{o.ahead, 0.0, 0.0};
    if (!o.poses.empty()) writePoses(o.poses + "_" + std::to_string(seed) + ".txt", run.poses);
    const core::RelationScore s = core::scoreRelations(run.poses, relations);
    if (s.translation.empty()) throw std::runtime_error("no relation has both its poses in the log");
    report(seed, run, s);
    translation.push_back(s.absoluteTranslation().mean);
    rotation.push_back(core::degrees(s.absoluteRotation().mean));
    cost.insert(cost.end(), run.cost_ms.begin(), run.cost_ms.end());
  }
  const std::string name = "figure slam/" + o.name;
  std::printf("%s/translation_mean %.4f m\n", name.c_str(), mean(translation));
  std::printf("%s/translation_worst %.4f m\n", name.c_str(), *std::max_element(translation.begin(), translation.end()));
  std::printf("%s/rotation_mean %.3f deg\n", name.c_str(), mean(rotation));
  bench::print("slam/" + o.name + "/cost", bench::medianFigure(cost), "ms");
  std::printf("%s/memory %.1f MB\n", name.c_str(), bench::peakMb() - before);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  o.params.threads = 1;
  std::vector<std::string> sets;
  CLI::App app("Runs the grid SLAM on a CARMEN log and scores the best path by relations.");
  app.add_option("log", o.log, "FLASER, ROBOTLASER1 or RAWLASER1 lines")->required();
  app.add_option("relations", o.relations, "between poses of the scanner")->required();
  app.add_option("--name", o.name, "of the log in the figures");
  app.add_option("--poses", o.poses, "writes the best paths to POSES_SEED.txt");
  app.add_option("--ahead", o.ahead, "[m] of the scanner before the odometry's centre");
  app.add_option("--seeds", o.seeds)->check(CLI::Range(1, 1000));
  app.add_option("--set", sets, "NAME=VALUE of parameters; updates at 0 take every scan in");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& text : sets) bench::setParam(o.params, text);
    score(o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_slam_log: %s\n", e.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
