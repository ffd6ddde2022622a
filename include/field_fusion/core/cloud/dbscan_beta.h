#pragma once
// DBSCAN that does not reach across a step in depth (paper 001, section on clustering).
#include <cstdint>
#include <vector>

#include "field_fusion/core/cloud/cell_grid.h"
#include "field_fusion/core/cloud/depth_step.h"
#include "field_fusion/core/cloud/disjoint_sets.h"

namespace field_fusion::core {

/// Exact, with the rules of `Dbscan`, but for who are neighbours: two points within epsilon whose angle beta
/// (paper 001 Eq. 7, see DepthStep) is above theta. Equal points are neighbours; two points on one ray are
/// not, so a point at the sensor's origin has only its equals. Costs time with the number of pairs within
/// epsilon, unlike `Dbscan`. Keeps its buffers from cloud to cloud.
class DbscanBeta {
 public:
  /// `epsilon` [m] >= 0.01, `min_points` >= 1, `theta` [rad] in [0, pi / 2), else std::invalid_argument.
  /// Returns for each point its cluster 0, 1, ... (in no particular order) or kNoise.
  const std::vector<int>& run(const Cloud& cloud, float epsilon, int min_points, double theta);

  int clusterCount() const { return cluster_count_; }
  std::size_t usableCount() const { return grid_.pointCount(); }

 private:
  Eigen::Vector3f position(std::uint32_t i) const { return {grid_.xs()[i], grid_.ys()[i], grid_.zs()[i]}; }
  float distance2(std::uint32_t i, std::uint32_t j) const;
  bool neighbours(std::uint32_t i, std::uint32_t j) const;
  IndexRange extent(CellGrid::Run run) const;

  bool isCore(std::size_t cell, std::uint32_t point, int min_points) const;
  void joinWithin(std::size_t cell);
  void joinAcross(std::size_t a, std::size_t b);
  void labelPoints();
  int borderLabel(std::size_t cell, std::uint32_t point) const;

  CellGrid grid_;
  float radius2_ = 0.f;
  BetaTest same_depth_;
  std::vector<char> core_;       // of each sorted point
  DisjointSets sets_;            // of the sorted points; only core points are joined
  std::vector<char> whole_;      // of each cell: its core points are one set without the help of other cells
  std::vector<int> core_label_;  // of each core point
  std::vector<int> labels_;
  int cluster_count_ = 0;
};

}  // namespace field_fusion::core
