#pragma once
// What the LiDAR saw of one body, and how that looks from a camera.
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/cluster.h"

namespace field_fusion::core {

/// A cluster or, where several detections share one, a part of it.
struct LidarTarget {
  Cluster cluster;                     ///< of the part alone; its `points` have no meaning then
  int place = -1;                      ///< of the whole in the list of clusters
  int part = 0;                        ///< 0: the whole; 1, 2, ...: a part of it
  std::vector<std::uint32_t> members;  ///< of a part: places of its points among those of all clusters
};

/// A cluster seen from a camera, in the view frame.
struct Sight {
  Polar centre{kNaN, kNaN, kNaN};
  double depth = kNaN;   ///< [m] extent along the line of sight
  double width = kNaN;   ///< [rad]
  double height = kNaN;  ///< [rad]
};

/// Extents are those of the oriented box, or of the axis-aligned one where that is not known. NaN throughout
/// for a transform that is not finite and for a cluster that surrounds the camera.
Sight sightOf(const Cluster& cluster, const Transform& T_view_lidar);

}  // namespace field_fusion::core
