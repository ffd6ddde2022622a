#pragma once
// Clusters of a scan by the step in depth from ray to ray, which holds at any range and ring spacing.
#include <cstdint>
#include <vector>

#include "field_fusion/core/cloud/depth_step.h"
#include "field_fusion/core/cloud/disjoint_sets.h"

namespace field_fusion::core {

/// Joins points that follow each other in a row of the scanner, or lie above each other in neighbouring rows,
/// where beta (paper 001 Eq. 7; Bogoslavskyi, Stachniss 2016) is above theta and the step in depth |AC| is at
/// most epsilon. The second limit keeps a car off the wall behind it: rows 2 deg apart make beta large.
///
/// Rows are the points' rings, 0 the lowest. Where a usable point's ring is unknown they come from the
/// elevations in ascending order: a row ends before a gap of more than 0.1 deg, and after 0.4 deg. Within a
/// row points are ordered by azimuth and no columns are formed, so any layout will do. A point is compared
/// with the 12 that follow it in its row, which reaches past a pole, and in each of the next two rows, up to
/// 5 deg above, with the four nearest in azimuth. Both must be within 0.5 deg in azimuth, or |BC| within
/// epsilon.
///
/// A point at the origin has no ray and belongs to no cluster. Keeps its buffers from cloud to cloud.
class RangeImage {
 public:
  /// `epsilon` [m] > 0, `theta` [rad] in [0, pi / 2), else std::invalid_argument. Returns for each point its
  /// cluster 0, 1, ... (in no particular order, of any size), or kNoise.
  const std::vector<int>& run(const Cloud& cloud, double epsilon, double theta);

  int clusterCount() const { return cluster_count_; }
  std::size_t usableCount() const { return usable_count_; }

 private:
  struct Ray {
    std::uint32_t row;
    float azimuth, elevation;
    float range2;
    std::uint32_t index;
  };

  void collect(const Cloud& cloud);
  void findRowsByElevation();
  void sortRows();
  void joinInRow(const Cloud& cloud, std::uint32_t ray);
  void joinUpwards(const Cloud& cloud, std::uint32_t ray);
  void joinIfNear(const Cloud& cloud, std::uint32_t a, std::uint32_t b);
  void labelPoints();

  double epsilon_ = 0.0;
  BetaTest same_depth_;
  std::size_t usable_count_ = 0;
  bool rings_known_ = false;
  std::vector<Ray> rays_;                 // by row, then azimuth
  std::vector<std::uint32_t> row_start_;  // of each row in rays_, and the end of the last
  DisjointSets sets_;                     // of rays
  std::vector<int> ray_label_;
  std::vector<int> labels_;
  int cluster_count_ = 0;
};

}  // namespace field_fusion::core
