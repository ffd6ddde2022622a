#pragma once
// Uneven ground with bodies on it, as a spinning LiDAR sees it.
#include <functional>

#include "field_fusion/core/base/types.h"

namespace field_fusion::test {

/// [m] Height at a place; a body is a height as well, with steep sides.
using Relief = std::function<double(double x, double y)>;

struct ReliefScan {
  int rings = 64;
  double lowest = core::radians(-24.8), highest = core::radians(2.0);  ///< [rad] elevation
  int columns = 360;                                                   ///< over the sector
  double sector = core::radians(60.0);                                 ///< [rad] to either side of x
  double height = 1.8;                                                 ///< [m] of the sensor over z = 0
  double max_range = 60.0;                                             ///< [m]
};

/// The points in the sensor's frame, which stands over x = y = 0. Exact: no noise.
inline core::Cloud scanRelief(const Relief& relief, const ReliefScan& scan = {}) {
  constexpr double kStride = 0.05;
  core::Cloud out;
  for (int column = 0; column < scan.columns; ++column)
    for (int ring = 0; ring < scan.rings; ++ring) {
      const double azimuth = scan.sector * (2.0 * (column + 0.5) / scan.columns - 1.0);
      const double elevation = scan.lowest + (scan.highest - scan.lowest) * ring / (scan.rings - 1);
      const Eigen::Vector3d ray = core::cartesian({1.0, azimuth, elevation});
      const auto below = [&](double range) {
        const Eigen::Vector3d p = range * ray;
        return scan.height + p.z() < relief(p.x(), p.y());
      };
      double far = kStride;
      while (far < scan.max_range && !below(far)) far += kStride;
      if (far >= scan.max_range) continue;
      double near = far - kStride;
      for (int i = 0; i < 20; ++i) (below(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
      const Eigen::Vector3f p = (near * ray).cast<float>();
      core::Point point{p.x(), p.y(), p.z()};
      point.ring = static_cast<std::uint16_t>(ring);
      out.push_back(point);
    }
  return out;
}

}  // namespace field_fusion::test
