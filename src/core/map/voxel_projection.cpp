#include <algorithm>
#include <climits>
#include <cmath>

#include "field_fusion/core/map/voxel_map.h"

namespace field_fusion::core {
namespace {

std::int8_t percent(float log_odds) {
  return static_cast<std::int8_t>(std::lround(100.0 / (1.0 + std::exp(-static_cast<double>(log_odds)))));
}

}  // namespace

Occupancy VoxelMap::project() const {
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;
  store_.forEach([&](const CubeKey& place, const VoxelCube&) {
    x0 = std::min(x0, place.x()), x1 = std::max(x1, place.x() + 1);
    y0 = std::min(y0, place.y()), y1 = std::max(y1, place.y() + 1);
  });
  if (store_.size() == 0) return project(Column{0, 0, 0, 0});
  return project(Column{x0 * kCubeSide, y0 * kCubeSide, (x1 - x0) * kCubeSide, (y1 - y0) * kCubeSide});
}

Occupancy VoxelMap::projectAbout(double x, double y, double side) const {
  const int cells = static_cast<int>(std::lround(side / params_.resolution));
  return project(Column{static_cast<int>(std::lround(x / params_.resolution)) - cells / 2,
                        static_cast<int>(std::lround(y / params_.resolution)) - cells / 2, cells, cells});
}

Occupancy VoxelMap::project(const Column& area) const {
  // voxels whose middle lies between the heights
  const int low = static_cast<int>(std::ceil(params_.min_height / params_.resolution - 0.5));
  const int high = static_cast<int>(std::floor(params_.max_height / params_.resolution - 0.5));
  std::vector<float> highest(static_cast<std::size_t>(area.width) * area.height, -INFINITY);
  store_.forEach([&](const CubeKey& place, const VoxelCube& cube) {
    const VoxelKey first = place * kCubeSide;
    if (first.z() > high || first.z() + kCubeSide <= low) return;
    if (first.x() >= area.x0 + area.width || first.x() + kCubeSide <= area.x0) return;
    if (first.y() >= area.y0 + area.height || first.y() + kCubeSide <= area.y0) return;
    forEachBit(cube.known, [&](int i) {
      const VoxelKey voxel = voxelOf(place, i);
      const int u = voxel.x() - area.x0, v = voxel.y() - area.y0;
      if (voxel.z() < low || voxel.z() > high || u < 0 || v < 0 || u >= area.width || v >= area.height)
        return;
      float& cell = highest[static_cast<std::size_t>(v) * area.width + u];
      cell = std::max(cell, cube.log_odds[i]);
    });
  });
  Occupancy out = {params_.resolution,
                   area.x0 * params_.resolution,
                   area.y0 * params_.resolution,
                   area.width,
                   area.height,
                   {}};
  out.cells.reserve(highest.size());
  for (const float cell : highest) out.cells.push_back(std::isinf(cell) ? kUnknownCell : percent(cell));
  return out;
}

}  // namespace field_fusion::core
