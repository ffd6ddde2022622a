// What the grid SLAM costs in the simulated office: time of a scan, threads, the map message, memory; and over hours.
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>

#include "field_fusion/core/map/occupancy.h"
#include "office_log.h"

namespace {

using namespace field_fusion;

bench::OfficeLog logOf(const char* step, const core::GridSlamParams& p) {
  return bench::officeLog(1, {"360", step, true}, {p.min_range, p.usable_range, p.max_range});
}

double wallMs() {
  return 1e-6 * static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count());
}

/// The map as it goes out after each scan that was taken in: what has changed is drawn, all is copied.
struct MapMessage {
  core::OccupancyDrawer drawer;
  std::vector<double> cost_ms;

  void make(const core::GridSlam& slam) {
    cost_ms.push_back(bench::costMs([&] { return drawer.update(slam.best().map).cells; }));
  }
};

/// Figures of one run over the office; the map message too.
void cost(const char* name, const bench::OfficeLog& log, const core::GridSlamParams& params) {
  const double before = bench::residentMb();
  core::GridSlam slam(params);
  MapMessage message;
  std::vector<double> ms;
  for (const bench::LogScan& scan : log.scans) {
    auto outcome = core::GridSlam::Outcome::kSkipped;
    const double took = bench::costMs([&] { outcome = slam.process(scan.points, scan.odometry, scan.stamp_ns); });
    if (outcome != core::GridSlam::Outcome::kProcessed) continue;
    ms.push_back(took), message.make(slam);
  }
  bench::print(std::string("slam/cost_") + name, bench::medianFigure(ms), "ms");
  if (std::string(name) != "360") return;
  std::printf("figure slam/memory %.1f MB\n", bench::peakMb() - before);
  bench::print("slam/map_message", bench::medianFigure(message.cost_ms), "ms");
  std::printf("figure slam/map_message_worst %.3g ms\n", *std::max_element(message.cost_ms.begin(), message.cost_ms.end()));
}

/// Wall time of whole runs in turns, one thread and two.
void threads(const bench::OfficeLog& log, core::GridSlamParams params, int repeats) {
  std::vector<double> ratios;
  for (int k = 0; k < repeats; ++k) {
    double took[2];
    for (const int number : {1, 2}) {
      params.threads = number;
      core::GridSlam slam(params);
      const double start = wallMs();
      for (const bench::LogScan& scan : log.scans) slam.process(scan.points, scan.odometry, scan.stamp_ns);
      took[number - 1] = wallMs() - start;
    }
    ratios.push_back(took[0] / took[1]);
  }
  bench::print("slam/threads_2/speedup", bench::medianFigure(ratios), "-");
}

/// Lap after lap, odometry drifting on and on.
void hours(const bench::OfficeLog& log, const core::GridSlamParams& params, double length) {
  core::GridSlam slam(params);
  core::Pose2 T_odom_lap;
  const double lap_hours = 1e-9 / 3600.0 * static_cast<double>(log.scans.back().stamp_ns);
  double first = 0.0, most = 0.0;
  int lap = 0;
  for (double done = 0.0; done < length; done += lap_hours, ++lap) {
    for (const bench::LogScan& scan : log.scans)
      slam.process(scan.points, T_odom_lap * core::between(log.scans.front().odometry, scan.odometry),
                   scan.stamp_ns + lap * (log.scans.back().stamp_ns + 100'000'000));
    T_odom_lap = T_odom_lap * core::between(log.scans.front().odometry, log.scans.back().odometry);
    if (lap == 1) first = bench::residentMb();
    most = std::max(most, bench::residentMb());
    std::fprintf(stderr, "\r%.2f of %.2f h, %.1f MB", done + lap_hours, length, bench::residentMb());
  }
  std::fprintf(stderr, "\n");
  std::printf("%d laps; resident after two %.1f MB, at most %.1f MB\n", lap, first, most);
  std::printf("figure slam/hours/growth %.3f -\n", most / first);
}

/// For other programs: the log of 360 or 720 beams as CARMEN writes it. A beam without return has 100 m.
void writeCarmen(const std::string& file, const bench::OfficeLog& log) {
  std::ofstream out(file);
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const core::Scan& scan = log.raw[i];
    const core::Pose2 &o = log.scans[i].odometry, laser = o * core::Pose2{0.2, 0.0, 0.0};
    out << "ROBOTLASER1 0 " << scan.angle_min << " " << 6.283185307 << " " << scan.angle_increment << " 100 0.01 0 "
        << scan.ranges.size();
    for (const float range : scan.ranges) out << " " << (std::isfinite(range) ? range : 100.f);
    out << " 0 " << laser.x << " " << laser.y << " " << laser.yaw << " " << o.x << " " << o.y << " " << o.yaw << " 0 0 0 0 0 ";
    const std::string stamp = std::to_string(1000.0 + 1e-9 * static_cast<double>(log.scans[i].stamp_ns));
    out << stamp << " office " << stamp << "\n";
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace

int main(int argc, char** argv) {
  core::GridSlamParams params;
  params.threads = 1;
  double length = 0.0;
  int repeats = 5;
  std::string logs;
  std::vector<std::string> sets;
  CLI::App app("Measures the grid SLAM in the simulated office, 360 and 720 beams up to 10 m.");
  app.add_option("--hours", length, "instead: so long a log in a row, and what memory does")->check(CLI::Range(0.01, 1000.0));
  app.add_option("--write-logs", logs, "instead: writes the logs as LOGS_360.log and LOGS_720.log (CARMEN)");
  app.add_option("--repeats", repeats, "whole runs with one and two threads")->check(CLI::Range(1, 100));
  app.add_option("--set", sets, "NAME=VALUE of parameters");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& text : sets) bench::setParam(params, text);
    const bench::OfficeLog log = logOf("1.0", params);
    if (length > 0.0) return hours(log, params, length), EXIT_SUCCESS;
    if (!logs.empty()) {
      writeCarmen(logs + "_360.log", log), writeCarmen(logs + "_720.log", logOf("0.5", params));
      return EXIT_SUCCESS;
    }
    cost("360", log, params), cost("720", logOf("0.5", params), params);
    threads(log, params, repeats);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_slam: %s\n", e.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
