#pragma once
// What the LiDAR saw of one body, and how that looks from a camera.
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/cluster.h"

namespace field_fusion::core {

/// A cluster, a part of one that several detections share, or several that are pieces of one body.
struct LidarTarget {
  Cluster cluster;                     ///< of the part or of the pieces together; its `points` are void then
  int place = -1;                      ///< of the whole, or of the main piece, in the list of clusters
  int part = 0;                        ///< 0: the whole; 1, 2, ...: a part of it
  std::vector<std::uint32_t> members;  ///< unless a whole cluster: places of its points among those of all
  std::vector<int> joined{};           ///< places of the pieces beside the main one
};

/// Calls `use` with the place of each point among those of all clusters.
template <class Use>
void forEachPoint(const LidarTarget& body, const Use& use) {
  for (const std::uint32_t i : body.members) use(i);
  if (!body.members.empty()) return;
  for (std::uint32_t i = 0; i < body.cluster.points.count; ++i) use(body.cluster.points.first + i);
}

/// Fills in `cluster` from the points of `members`, one at least; the oriented box only with a fitter.
void describeMembers(LidarTarget& body, const std::vector<Point>& points, OrientedBoxFitter* fitter);

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
