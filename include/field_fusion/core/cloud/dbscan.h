#pragma once
// Exact DBSCAN (Ester, Kriegel, Sander, Xu 1996) on a grid whose cells are small enough that all points
// of one cell are neighbours of each other.
#include <array>
#include <cstdint>
#include <vector>

#include "field_fusion/core/cloud/cell_grid.h"
#include "field_fusion/core/cloud/disjoint_sets.h"

namespace field_fusion::core {

/// Label of a point that belongs to no cluster.
constexpr int kNoise = -1;

/// [m^2] Squared distance in float arithmetic. Two points are neighbours when it is at most
/// epsilon * epsilon, also in float.
inline float squaredDistance(float ax, float ay, float az, float bx, float by, float bz) {
  const float dx = ax - bx, dy = ay - by, dz = az - bz;
  return dx * dx + dy * dy + dz * dz;
}

/// [m] Side of the cells in which all points are neighbours of each other.
double cellSide(float epsilon);

/// Labels the points of a cloud. A point is core when at least `min_points` points, itself counted, are
/// its neighbours; core points that are neighbours share a cluster; any other point with a core neighbour
/// is a border point of its nearest core point's cluster (of two equally near, the one earlier in the
/// cloud); the rest is noise. So the result does not depend on the order of the points but for such ties.
/// Unusable points (see `usable`) are noise and nobody's neighbours. Keeps its buffers from cloud to cloud.
class Dbscan {
 public:
  /// `epsilon` [m] >= 0.01, `min_points` >= 1, else std::invalid_argument.
  /// Returns for each point its cluster 0, 1, ... (in no particular order) or kNoise.
  const std::vector<int>& run(const Cloud& cloud, float epsilon, int min_points);

  /// Clusters in which every two points are linked by steps shorter than `tolerance` [m] >= 0.01: those of
  /// pcl::EuclideanClusterExtraction, however few their points are.
  const std::vector<int>& runEuclidean(const Cloud& cloud, float tolerance);

  int clusterCount() const { return cluster_count_; }
  std::size_t usableCount() const { return grid_.pointCount(); }

 private:
  struct Box {
    std::array<float, 3> low, high;
  };

  const std::vector<int>& label(const Cloud& cloud, double side, std::uint32_t min_points);
  void markCores(std::uint32_t min_points);
  void markCoresOf(std::size_t cell, std::uint32_t min_points);
  void collectCores();
  void joinCells();
  bool linked(std::size_t a, std::size_t b) const;
  void numberClusters();
  void labelPoints(std::vector<int>& labels) const;
  int borderLabel(std::size_t cell, std::uint32_t point) const;

  CellGrid grid_;
  float radius2_ = 0.f;
  std::vector<char> core_;                 // of each sorted point
  std::vector<std::uint32_t> core_start_;  // first core point of each cell in the lists below
  std::vector<float> core_x_, core_y_, core_z_;
  std::vector<std::uint32_t> core_index_;
  std::vector<Box> core_box_;  // of each cell that has core points
  DisjointSets sets_;          // of cells
  std::vector<int> cell_label_;
  std::vector<int> labels_;
  int cluster_count_ = 0;
};

}  // namespace field_fusion::core
