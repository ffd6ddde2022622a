#pragma once
// Points to bodies: clusters by one of several methods, and the boxes, range and azimuth of each.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/dbscan.h"
#include "field_fusion/core/cloud/dbscan_beta.h"
#include "field_fusion/core/cloud/oriented_box.h"
#include "field_fusion/core/cloud/range_image.h"
#include "field_fusion/core/cloud/row_spacing.h"
#include "field_fusion/core/cloud/seen_through.h"

namespace field_fusion::core {

enum class ClusterMethod { kAdaptive, kDbscan, kDbscanBeta, kRangeImage, kEuclidean };

struct ClusterParams {
  ClusterMethod method = ClusterMethod::kAdaptive;
  double epsilon = 0.5;
  double theta = 10.0;
  int min_points = 10;
  double full_range = 20.0;
  double row_gap = 0.0;
  double see_through = 3.5;
  int max_points = 10000000;
  bool oriented_boxes = true;
  bool faint = false;

  void declare(Params& p) {
    p.choice("method", method, {"adaptive", "dbscan", "dbscan_beta", "range_image", "euclidean"}, When::kLive,
             "What makes points one cluster. adaptive: density in step with the scanner's resolution. "
             "dbscan: density. dbscan_beta: density, not across steps in depth "
             "(paper 001). range_image: no step in depth from ray to ray. euclidean: nearness, as PCL.");
    p.number("epsilon", epsilon, {0.01, 5.0}, "m", When::kLive,
             "Neighbourhood radius; range_image: largest step in depth.");
    p.number("theta", theta, {0.0, 89.0}, "deg", When::kLive,
             "dbscan_beta, range_image: a smaller angle beta (paper 001 Eq. 7) is a step in depth.");
    p.number("min_points", min_points, {1, 1000}, "points", When::kLive,
             "dbscan, dbscan_beta: neighbours, itself counted, that make a core point. Else: fewest of a "
             "cluster.");
    p.number("full_range", full_range, {0.1, 1000.0}, "m", When::kLive,
             "adaptive: farther clusters need fewer points, by (full_range / range)^2, but 4 at least.");
    p.number("row_gap", row_gap, {0.0, 30.0}, "deg", When::kLive,
             "adaptive: angle between the rows of the scanner; 0: measured from the rings in the cloud.");
    p.number("see_through", see_through, {0.0, 20.0}, "m", When::kLive,
             "adaptive: small clusters seen through openings of a larger one, so far behind it, belong to "
             "it; 0: none do.");
    p.number("max_points", max_points, {1, 10000000}, "points", When::kLive,
             "Larger clusters are left out and counted.");
    p.flag("oriented_boxes", oriented_boxes, When::kLive, "Also fit a box turned about z to each cluster.");
    p.flag("faint", faint, When::kLive,
           "Also tell, marked as such, of points that are too few for a cluster: match keeps those that a "
           "camera supports.");
  }
};

/// One body. Its points are `Clusters::points[points.first ...]`.
struct Cluster {
  IndexRange points;
  Eigen::AlignedBox3f box;                           ///< [m] paper 001 Eq. 8
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< [m] paper 001 Eq. 9
  Polar polar;                                       ///< of the centre; paper 001 Eqs. 10 and 11
  float nearest_range = 0;                           ///< [m] to the nearest point
  OrientedBox oriented_box;                          ///< NaN without ClusterParams::oriented_boxes
  bool faint = false;                                ///< too few points to be a body by itself
};

/// Box, centre and their polar coordinates of at least one point; the oriented box only with a fitter.
void describe(Cluster& cluster, const Point* points, std::size_t count, OrientedBoxFitter* fitter);

struct Clusters {
  /// By nearest range, of equals the one that comes first in the cloud; the faint ones after all others.
  std::vector<Cluster> clusters;
  std::vector<Point> points;      ///< grouped by cluster, in the order of the cloud
  std::vector<int> labels;        ///< of each point of the cloud: its place in `clusters`, or kNoise
  std::size_t noise = 0;          ///< points that belong to no cluster but faint ones
  std::size_t faint = 0;          ///< clusters that are faint
  std::size_t unusable = 0;       ///< points that are not finite or too far away to be placed
  double row_gap = kNaN;          ///< [rad] between rows, for the method adaptive; 0: not known
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

  /// What a method found: the set of each point of the cloud, or kNoise.
  struct Sets {
    const std::vector<int>& labels;
    int count;
    std::size_t usable;
  };

  Sets separate(const Cloud& cloud);
  Sets separateAdaptively(const Cloud& cloud);
  double fewest(float nearest2) const;
  std::size_t measure(const Cloud& cloud, const Sets& sets);
  void choose();
  void sortByRange();
  void label(const Cloud& cloud, const std::vector<int>& sets);
  void append(const Cloud& cloud, const std::vector<int>& sets, bool faint);
  void addFaint(const Cloud& cloud, const std::vector<int>& sets);
  void describeAll();

  ClusterParams params_;
  Dbscan dbscan_;
  DbscanBeta dbscan_beta_;
  RangeImage range_image_;
  RowSpacing row_spacing_;
  SeenThrough seen_through_;
  OrientedBoxFitter box_fitter_;
  std::vector<Extent> extents_;  // of each set
  std::vector<int> kept_;        // sets that become clusters, in the order of the result
  std::vector<int> place_;       // of each set in the result, or kNoise
  Cloud closed_;                 // the cloud with its rows closed up
  Cloud rest_;                   // what belongs to no cluster
  Clusters result_;
};

}  // namespace field_fusion::core
