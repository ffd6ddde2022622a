#pragma once
// Makes up for the rows of a scanner, which drift apart with range until a body falls into slices.
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Keeps its buffers from cloud to cloud.
class RowSpacing {
 public:
  /// [rad] Angle between neighbouring rows: the median over the rows that have points, a row's elevation
  /// being the middle of its points' elevations. 0 where no two neighbouring rings are known.
  double measure(const Cloud& cloud);

  /// Copies `cloud` to `out` (not `cloud` itself) and lowers the heights of points at range r by the factor
  /// epsilon / (1.2 gap r) where that is below 1: neighbouring rows, which are gap * r apart, then lie within
  /// epsilon at any range. `gap` [rad] 0 copies only. Order, azimuth and near points stay as they are.
  static void close(const Cloud& cloud, double gap, double epsilon, Cloud& out);

 private:
  struct Row {
    float low, high;  // tangent of the elevation
  };
  std::vector<Row> rows_;
  std::vector<double> gaps_;
};

}  // namespace field_fusion::core
