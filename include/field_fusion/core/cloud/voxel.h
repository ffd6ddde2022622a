#pragma once
// Thins a cloud to one point a voxel.
#include <cstdint>
#include <vector>

#include "field_fusion/core/cloud/cell_grid.h"

namespace field_fusion::core {

/// Of the points in each cube of a lattice through the origin, keeps the one nearest to their centroid (of
/// two equally near, the earlier). A measured point, unlike the centroid itself, has a true ring, time and
/// intensity. Keeps its buffers from cloud to cloud.
class Voxels {
 public:
  /// Writes the kept points to `out` (not `cloud` itself) in their order. Unusable points are dropped.
  /// `side` [m] >= kSmallestCell, else std::invalid_argument.
  void run(const Cloud& cloud, double side, Cloud& out);

 private:
  CellGrid grid_;
  std::vector<char> keep_;
};

}  // namespace field_fusion::core
