#pragma once
// Points to bodies: DBSCAN and the box, range and azimuth of each cluster.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/dbscan.h"

namespace field_fusion::core {

struct ClusterParams {
  double epsilon = 0.5;
  int min_points = 10;
  int max_points = 10000000;

  void declare(Params& p) {
    p.number("epsilon", epsilon, {0.01, 5.0}, "m", When::kLive, "Neighbourhood radius of DBSCAN.");
    p.number("min_points", min_points, {1, 1000}, "points", When::kLive,
             "Points within epsilon, itself counted, that make a core point.");
    p.number("max_points", max_points, {1, 10000000}, "points", When::kLive,
             "Larger clusters are left out and counted.");
  }
};

/// One body. Its points are `Clusters::points[points.first ...]`.
struct Cluster {
  IndexRange points;
  Eigen::AlignedBox3f box;                           ///< [m] paper 001 Eq. 8
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< [m] paper 001 Eq. 9
  Polar polar;                                       ///< of the centre; paper 001 Eqs. 10 and 11
  float nearest_range = 0;                           ///< [m] to the nearest point
};

struct Clusters {
  std::vector<Cluster> clusters;  ///< by nearest range; of equals the one that comes first in the cloud
  std::vector<Point> points;      ///< grouped by cluster, in the order of the cloud
  std::vector<int> labels;        ///< of each point of the cloud: its place in `clusters`, or kNoise
  std::size_t noise = 0;          ///< points that belong to no cluster
  std::size_t unusable = 0;       ///< points that are not finite or too far away to be placed
  std::size_t too_large = 0;      ///< clusters left out for max_points; their points are labelled kNoise
};

/// Turns clouds into clusters. Keeps its buffers from cloud to cloud.
class Clusterer {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit Clusterer(const ClusterParams& params = {}) { setParams(params); }
  void setParams(const ClusterParams& params) { params_ = checked(params); }

  /// The result stays valid until the next call.
  const Clusters& run(const Cloud& cloud);

 private:
  struct Extent {
    std::uint32_t count = 0, first = 0;
    float nearest2 = 0.f;
  };

  void measure(const Cloud& cloud, const std::vector<int>& sets, int set_count);
  void order();
  void fill(const Cloud& cloud, const std::vector<int>& sets);
  void describe();

  ClusterParams params_;
  Dbscan dbscan_;
  std::vector<Extent> extents_;  // of each set of points that DBSCAN found
  std::vector<int> kept_;        // sets that are not too large, in the order of the result
  std::vector<int> place_;       // of each set in the result, or kNoise
  Clusters result_;
};

}  // namespace field_fusion::core
