#include "field_fusion/core/cloud/voxel.h"

#include <limits>

namespace field_fusion::core {
namespace {

/// Place, among the grid's points, of the one that stands for a cell.
std::uint32_t representative(const CellGrid& grid, IndexRange points) {
  const std::uint32_t end = points.first + points.count;
  const auto at = [&](std::uint32_t i) { return Eigen::Vector3d(grid.xs()[i], grid.ys()[i], grid.zs()[i]); };
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (std::uint32_t i = points.first; i < end; ++i) centroid += at(i);
  centroid /= points.count;

  std::uint32_t best = points.first;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = points.first; i < end; ++i) {
    const double distance2 = (at(i) - centroid).squaredNorm();
    if (distance2 < nearest) nearest = distance2, best = i;
  }
  return best;
}

}  // namespace

void Voxels::run(const Cloud& cloud, double side, Cloud& out) {
  grid_.build(cloud, side);
  keep_.assign(cloud.size(), 0);
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell)
    keep_[grid_.index()[representative(grid_, grid_.points(cell))]] = 1;
  out.clear();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (keep_[i]) out.push_back(cloud[i]);
}

}  // namespace field_fusion::core
