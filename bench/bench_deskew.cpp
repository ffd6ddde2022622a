// Cost of MDR: a planar scan of 1600 beams and a cloud of 28 800 points, 500 poses of the odometry a second.
#include <cstdio>

#include "../test/support/moving_scanner.h"
#include "field_fusion/core/cloud/deskew.h"
#include "field_fusion/core/scan/deskew.h"
#include "field_fusion/core/scan/vicp.h"
#include "figure.h"

namespace {

using namespace field_fusion;

constexpr int kRepeats = 501;
constexpr double kStamp = 2.0;

/// 16 rows of 1800 columns, as drivers send them: column by column.
core::Cloud cloud() {
  core::Cloud out;
  for (int k = 0; k < 28800; ++k) {
    const auto to =
        core::cartesian({10.0, core::radians(0.2 * (k / 16)), core::radians(2.0 * (k % 16) - 15.0)});
    core::Point p;
    p.x = static_cast<float>(to.x()), p.y = static_cast<float>(to.y()), p.z = static_cast<float>(to.z());
    p.time = 0.1f * static_cast<float>(k / 16) / 1800.f;
    out.push_back(p);
  }
  return out;
}

}  // namespace

int main() {
  const test::Scanner scanner;
  const core::Scan scan = scanner.scan({}, test::trot, kStamp);
  const core::PoseHistory history = test::historyOf(test::trot, kStamp - 0.5, kStamp + 0.2);
  const core::Cloud sweep = cloud();
  core::MotionTrack track;
  core::ScanDeskewer deskewer;
  core::Scan binned;
  core::Cloud points;
  const auto follow = [&](const core::Sweep& span) {
    track.follow(history, kStamp, span, span.at(core::Instant::kStart), scanner.T_base_scanner);
  };
  const auto scan_ms = bench::costs(kRepeats, [&] {
    follow(scanner.sweep());
    deskewer.run(scan, 0.0, scan.time_increment, track, binned, points);
  });
  const auto cloud_ms = bench::costs(kRepeats, [&] {
    follow(core::sweepOf(sweep).sweep);
    core::deskew(sweep, track, points);
  });
  core::Vicp vicp;
  double stamp = 0.0;
  const auto vicp_ms = bench::costs(31, [&] {
    const core::Scan walked = scanner.scan({}, test::trot, stamp += 0.1);
    core::scanPoints(walked, 0.0, walked.time_increment, points);
    vicp.run(points, stamp);
  });
  std::printf("%zu beams, %zu points, 500 poses a second\n", scan.ranges.size(), sweep.size());
  bench::print("deskew/scan_cost", bench::medianFigure(scan_ms), "ms");
  bench::print("deskew/vicp_cost", bench::medianFigure(vicp_ms), "ms");
  bench::print("deskew/cloud_cost", bench::medianFigure(cloud_ms), "ms");
  return 0;
}
