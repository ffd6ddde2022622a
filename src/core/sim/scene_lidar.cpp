#include "field_fusion/core/sim/scene_lidar.h"

namespace field_fusion::core {

SceneScan scan(const Scene& scene, double stamp, const SceneLidar& lidar, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const Eigen::Vector3d origin = lidar.T_base_lidar.translation();
  SceneScan out;
  out.body_points.resize(scene.size());
  for (int column = 0; column < lidar.columns; ++column) {
    const double turned = (column + 0.5) / lidar.columns - 0.5;  // of a turn, from behind over the right side
    for (int ring = 0; ring < lidar.rings; ++ring) {
      const double step = lidar.rings > 1 ? 2.0 * ring / (lidar.rings - 1) - 1.0 : 0.0;
      const Eigen::Vector3d ray = cartesian({1.0, radians(360.0) * turned, lidar.elevation * step});
      const Hit hit = cast(scene, stamp + turned * lidar.turn, origin, lidar.T_base_lidar.linear() * ray);
      if (!(hit.range < lidar.max_range)) continue;
      if (hit.body >= 0) ++out.body_points[static_cast<std::size_t>(hit.body)];
      const Eigen::Vector3f p = ((hit.range + lidar.range_noise * noise(random)) * ray).cast<float>();
      const float intensity = hit.body == Hit::kGround ? 10.f : 60.f;
      out.cloud.push_back({p.x(), p.y(), p.z(), intensity, static_cast<float>(turned * lidar.turn),
                           static_cast<std::uint16_t>(ring)});
    }
  }
  return out;
}

}  // namespace field_fusion::core
