#pragma once
#include <random>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/sim/scene.h"

namespace field_fusion::core {

/// A scanner that turns counter-clockwise; the stamp of a cloud is when it looks along x.
struct SceneLidar {
  int rings = 16;
  int columns = 1800;
  double elevation = radians(15.0);  ///< [rad] of the highest ring; the lowest has its negative
  double turn = 0.1;                 ///< [s]
  double max_range = 100.0;          ///< [m] farther returns are lost
  double range_noise = 0.02;         ///< [m] standard deviation
  Transform T_base_lidar = Transform(Eigen::Translation3d(0.0, 0.0, 1.73));
};

struct SceneScan {
  Cloud cloud;                   ///< LiDAR's frame; column by column, rings from low to high
  std::vector<int> body_points;  ///< returns from each body of the scene
};

/// One turn around `stamp` [s]; each ray sees the scene of its own time.
SceneScan scan(const Scene& scene, double stamp, const SceneLidar& lidar, std::mt19937& random);

}  // namespace field_fusion::core
