#include "field_fusion/core/map/slam_scan.h"

#include <cmath>

namespace field_fusion::core {
namespace {

/// Three ends in a row that lie on a straight wall. Seen at a flat angle a wall is but a row of distant dots; the
/// map cannot tell its direction then, the scan can.
void addWall(const Eigen::Vector2f& before, ScanHit& hit, const Eigen::Vector2f& after,
             const Eigen::Vector2f& origin) {
  constexpr float kOff = 0.03f, kLeast = 0.05f;  // m from the line; m along it, for a direction above the noise
  constexpr float kFlat = 0.04f;                 // sine between beam and wall, below which it is a row of edges
  const Eigen::Vector2f along = after - before, beam = hit.end - origin;
  const float length = along.norm();
  if (length < kLeast) return;
  const Eigen::Vector2f normal = Eigen::Vector2f(-along.y(), along.x()) / length;
  if (std::abs(normal.dot(hit.end - before)) > kOff || std::abs(normal.dot(beam)) < kFlat * beam.norm()) return;
  hit.normal = normal;
}

}  // namespace

SlamScan slamScan(const Scan& scan, const Transform& T_base_sensor, const ScanLimits& limits) {
  SlamScan out;
  out.origin = T_base_sensor.translation().head<2>().cast<float>();
  std::vector<std::size_t> beams;
  for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
    const double range = reading(scan, k);
    if (!(range > 0.0 && range >= limits.min_range && range < limits.max_range)) continue;  // NaN too
    const double used = std::min(range, limits.usable_range);
    const Eigen::Vector2f end = (T_base_sensor * (used * scan.direction(k))).head<2>().cast<float>();
    if (range > limits.usable_range) {
      out.free.push_back(end);
      continue;
    }
    ScanHit hit;
    hit.end = end;
    out.hits.push_back(hit), beams.push_back(k);
  }
  for (std::size_t i = 1; i + 1 < beams.size(); ++i)
    if (beams[i + 1] - beams[i - 1] == 2) addWall(out.hits[i - 1].end, out.hits[i], out.hits[i + 1].end, out.origin);
  return out;
}

}  // namespace field_fusion::core
