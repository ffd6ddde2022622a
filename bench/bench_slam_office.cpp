// Grid SLAM in the simulated office: error of the whole trajectory against the true one.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>

#include "office_log.h"

namespace {

using namespace field_fusion;

/// [m] root mean square error of the scanner's places, the first pose laid on the true one: how it truly sits on the
/// robot nobody knows, and is no fault of the map.
double rmse(const bench::SlamRun& run, const bench::OfficeLog& log) {
  const auto found = [&](std::size_t i) { return run.poses[i].pose * log.T_base_nominal; };
  const auto truth = [&](std::size_t i) { return log.truth[i] * log.T_base_scanner; };
  const core::Pose2 T_world_map = truth(0) * core::inverse(found(0));
  double sum = 0.0;
  for (std::size_t i = 0; i < run.poses.size(); ++i)
    sum += (truth(i).position() - (T_world_map * found(i)).position()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(run.poses.size()));
}

/// For plots: true and estimated x, y, yaw of the scanner at each scan, each in its own frame.
void writePoses(const std::string& file, const bench::SlamRun& run, const bench::OfficeLog& log) {
  std::ofstream out(file);
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    for (const core::Pose2& q : {log.truth[i] * log.T_base_scanner, run.poses[i].pose * log.T_base_nominal})
      out << q.x << " " << q.y << " " << q.yaw << " ";
    out << "\n";
  }
}

double odometryError(const bench::OfficeLog& log) {
  const core::Pose2 T_world_odom = log.truth.front() * core::inverse(log.scans.front().odometry);
  return (log.truth.back().position() - (T_world_odom * log.scans.back().odometry).position()).norm();
}

}  // namespace

int main(int argc, char** argv) {
  core::GridSlamParams params;
  params.threads = 1;
  int seeds = 5;
  std::vector<std::string> sets;
  bench::OfficeScanner scanner;
  std::string name = "office", poses;
  CLI::App app("Runs the grid SLAM in the simulated office and compares the best path with the true one.");
  app.add_option("--seeds", seeds, "runs; each draws odometry, scans and particles anew")->check(CLI::Range(1, 1000));
  app.add_option("--view", scanner.view, "field of view [deg]"), app.add_option("--step", scanner.step, "from beam to beam [deg]");
  app.add_flag("--ideal", scanner.ideal, "up to 10 m alone, with a noise of 1 cm and a thin beam");
  app.add_option("--name", name, "of the figures"), app.add_option("--set", sets, "NAME=VALUE of parameters");
  app.add_option("--poses", poses, "writes true and estimated poses to POSES_SEED.txt");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& text : sets) bench::setParam(params, text);
    std::vector<double> errors, cost;
    for (int seed = 1; seed <= seeds; ++seed) {
      const auto log = bench::officeLog(static_cast<std::uint64_t>(seed), scanner,
                                        {params.min_range, params.usable_range, params.max_range});
      params.seed = seed;
      core::GridSlam slam(params);
      const bench::SlamRun run = bench::runSlam(slam, log.scans);
      errors.push_back(rmse(run, log));
      if (!poses.empty()) writePoses(poses + "_" + std::to_string(seed) + ".txt", run, log);
      cost.insert(cost.end(), run.cost_ms.begin(), run.cost_ms.end());
      std::printf("seed %d: %.1f m, odometry ends %.2f m off; %zu of %zu scans taken in, N_eff %.1f, RMSE %.4f m\n", seed,
                  log.way, odometryError(log), run.cost_ms.size(), log.scans.size(), run.effective, errors.back());
    }
    bench::print("slam/" + name + "/rmse_median", bench::medianFigure(errors), "m");
    std::printf("figure slam/%s/rmse_worst %.4g m\n", name.c_str(), *std::max_element(errors.begin(), errors.end()));
    bench::print("slam/" + name + "/cost", bench::medianFigure(cost), "ms");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_slam_office: %s\n", e.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
