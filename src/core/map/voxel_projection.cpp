#include <algorithm>
#include <climits>
#include <cmath>

#include "field_fusion/core/map/log_odds.h"
#include "field_fusion/core/map/voxel_map.h"

namespace field_fusion::core {

Occupancy VoxelMap::project() const {
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;
  store_.forEach([&](const CubeKey& place, const VoxelCube&) {
    x0 = std::min(x0, place.x()), x1 = std::max(x1, place.x() + 1);
    y0 = std::min(y0, place.y()), y1 = std::max(y1, place.y() + 1);
  });
  if (store_.size() == 0) return project(CellArea());
  return project(CellArea{x0 * kCubeSide, y0 * kCubeSide, (x1 - x0) * kCubeSide, (y1 - y0) * kCubeSide});
}

Occupancy VoxelMap::projectAbout(double x, double y, double side) const {
  return project(CellArea::about(x, y, side, params_.resolution));
}

Occupancy VoxelMap::project(const CellArea& area) const {
  // voxels whose middle lies between the heights
  const int low = static_cast<int>(std::ceil(params_.min_height / params_.resolution - 0.5));
  const int high = static_cast<int>(std::floor(params_.max_height / params_.resolution - 0.5));
  std::vector<float> highest(area.size(), -INFINITY);
  store_.forEach([&](const CubeKey& place, const VoxelCube& cube) {
    const VoxelKey first = place * kCubeSide;
    if (first.z() > high || first.z() + kCubeSide <= low) return;
    if (first.x() >= area.x0 + area.width || first.x() + kCubeSide <= area.x0) return;
    if (first.y() >= area.y0 + area.height || first.y() + kCubeSide <= area.y0) return;
    forEachBit(cube.known, [&](int i) {
      const VoxelKey voxel = voxelOf(place, i);
      if (voxel.z() < low || voxel.z() > high || !area.contains(voxel.x(), voxel.y())) return;
      float& cell = highest[area.index(voxel.x(), voxel.y())];
      cell = std::max(cell, cube.log_odds[i]);
    });
  });
  return pictureOf(area, params_.resolution, [&](int x, int y) {
    const float cell = highest[area.index(x, y)];
    return std::isinf(cell) ? kUnknownCell : percentOf(cell);
  });
}

}  // namespace field_fusion::core
