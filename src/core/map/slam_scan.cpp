#include "field_fusion/core/map/slam_scan.h"

namespace field_fusion::core {

SlamScan slamScan(const std::vector<float>& ranges, double angle_min, double angle_increment,
                  const Transform& T_base_sensor, const ScanLimits& limits) {
  SlamScan out;
  out.origin = T_base_sensor.translation().head<2>().cast<float>();
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const double range = ranges[k];
    if (!(range > 0.0 && range >= limits.min_range && range < limits.max_range)) continue;  // NaN too
    const double angle = angle_min + static_cast<double>(k) * angle_increment;
    const double used = std::min(range, limits.usable_range);
    const Eigen::Vector3d end =
        T_base_sensor * Eigen::Vector3d(used * std::cos(angle), used * std::sin(angle), 0.0);
    (range <= limits.usable_range ? out.hits : out.free).push_back(end.head<2>().cast<float>());
  }
  return out;
}

}  // namespace field_fusion::core
