#pragma once
// An analytic room for the grid SLAM's tests: what a scanner would see without error.
#include <cmath>
#include <vector>

#include "field_fusion/core/base/pose2.h"
#include "field_fusion/core/map/slam_scan.h"

namespace field_fusion::test {

/// [m] to the walls of the room [-4, 5] x [-3, 2] from inside, with a pillar of radius 0.4 m at (2, 0.5).
inline double roomRange(double x, double y, double angle) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  double range = HUGE_VAL;
  if (dx != 0.0) range = std::min(range, ((dx > 0 ? 5.0 : -4.0) - x) / dx);
  if (dy != 0.0) range = std::min(range, ((dy > 0 ? 2.0 : -3.0) - y) / dy);
  const double px = 2.0 - x, py = 0.5 - y, along = px * dx + py * dy;
  const double off2 = px * px + py * py - along * along;
  if (along > 0.0 && off2 < 0.16) range = std::min(range, along - std::sqrt(0.16 - off2));
  return range;
}

/// All round, a beam a degree.
inline core::SlamScan roomScan(const core::Pose2& pose, int beams = 360) {
  core::Scan scan;
  const double step = 2.0 * core::radians(180.0) / beams;
  scan.angle_increment = step, scan.range_max = 100.0;
  for (int k = 0; k < beams; ++k)
    scan.ranges.push_back(static_cast<float>(roomRange(pose.x, pose.y, pose.yaw + step * k)));
  return core::slamScan(scan, core::Transform::Identity(), {0.0, 40.0, 80.0});
}

}  // namespace field_fusion::test
