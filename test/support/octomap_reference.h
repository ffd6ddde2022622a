#pragma once
// The OctoMap library itself, with the sensor model of a VoxelMap: what that must equal.
#include <octomap/OcTree.h>

#include "field_fusion/core/map/voxel_map.h"

namespace field_fusion::test {

inline octomap::OcTree octreeLike(const core::VoxelMapParams& p) {
  octomap::OcTree tree(p.resolution);
  tree.setProbHit(p.hit), tree.setProbMiss(p.miss), tree.setOccupancyThres(p.occupied);
  tree.setClampingThresMin(p.clamp_min), tree.setClampingThresMax(p.clamp_max);
  return tree;
}

inline octomap::Pointcloud octomapCloud(const std::vector<Eigen::Vector3f>& points) {
  octomap::Pointcloud out;
  for (const auto& p : points) out.push_back(p.x(), p.y(), p.z());
  return out;
}

inline octomap::point3d octomapPoint(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

struct VoxelDifference {
  std::size_t voxels = 0;     ///< known to either
  std::size_t different = 0;  ///< known to one alone, or of other log-odds by as little as a bit
};

/// All voxels of both.
inline VoxelDifference difference(const core::VoxelMap& map, const octomap::OcTree& tree) {
  VoxelDifference out;
  std::size_t both = 0;
  map.store().forEach([&](const core::CubeKey& place, const core::VoxelCube& cube) {
    core::forEachBit(cube.known, [&](int i) {
      const core::VoxelKey voxel = core::voxelOf(place, i);
      const auto part = [&](int axis) {
        return static_cast<octomap::key_type>(voxel[axis] + core::kMostVoxels);
      };
      const auto* node = tree.search(octomap::OcTreeKey(part(0), part(1), part(2)));
      ++out.voxels, both += node != nullptr;
      out.different += !node || node->getLogOdds() != cube.log_odds[i];
    });
  });
  std::size_t theirs = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    theirs += std::size_t{1} << 3 * (tree.getTreeDepth() - leaf.getDepth());
  out.voxels += theirs - both, out.different += theirs - both;
  return out;
}

}  // namespace field_fusion::test
