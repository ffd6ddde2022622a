#include "field_fusion/core/map/voxel_lattice.h"

#include <cmath>
#include <limits>

namespace field_fusion::core {

std::optional<VoxelKey> VoxelLattice::key(const Eigen::Vector3f& place) const {
  VoxelKey out;
  for (int i = 0; i < 3; ++i) {
    const double cell = std::floor(per_metre_ * place[i]);
    if (!(cell >= -kMostVoxels && cell < kMostVoxels)) return std::nullopt;
    out[i] = static_cast<int>(cell);
  }
  return out;
}

std::optional<VoxelRay> VoxelRay::between(const VoxelLattice& lattice, const Eigen::Vector3f& origin,
                                          const Eigen::Vector3f& end) {
  const auto first = lattice.key(origin), last = lattice.key(end);
  if (!first || !last) return std::nullopt;
  VoxelRay ray;
  ray.begin = *first, ray.end = *last;
  if (ray.begin == ray.end) return ray;
  // single and double precision by turns, as octomap::point3d and its keys have them
  Eigen::Vector3f way = end - origin;
  ray.length = static_cast<float>(
      std::sqrt(static_cast<double>(way.x() * way.x() + way.y() * way.y() + way.z() * way.z())));
  way /= ray.length;
  const Eigen::Vector3d centre = lattice.centre(ray.begin);
  for (int i = 0; i < 3; ++i) {
    ray.step[i] = way[i] > 0.f ? 1 : way[i] < 0.f ? -1 : 0;
    ray.next[i] = ray.span[i] = std::numeric_limits<double>::max();
    if (ray.step[i] == 0) continue;
    const double border = centre[i] + static_cast<float>(ray.step[i] * lattice.resolution() * 0.5);
    ray.next[i] = (border - origin[i]) / way[i];
    ray.span[i] = lattice.resolution() / std::fabs(way[i]);
  }
  return ray;
}

}  // namespace field_fusion::core
