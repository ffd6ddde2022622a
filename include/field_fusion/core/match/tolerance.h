#pragma once
// Which LiDAR target and which camera target are one body: tolerances on range and azimuth.
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/match/verdict.h"

namespace field_fusion::core {

struct ToleranceParams {
  double dist_tolerance = 1.5;
  double angle_tolerance = 5.0;

  void declare(Params& p) {
    p.number("dist_tolerance", dist_tolerance, {0.001, 100.0}, "m", When::kLive,
             "Largest difference in range of a LiDAR and a camera target that match.");
    p.number("angle_tolerance", angle_tolerance, {0.001, 180.0}, "deg", When::kLive,
             "Largest difference in azimuth of a LiDAR and a camera target that match.");
  }
};

/// Tolerance-based matching, paper 001 Eqs. 12 and 13: range and azimuth both differ by no more than their
/// tolerances, the limits included. A target without range or azimuth (NaN) cannot satisfy Eq. 13.
///
/// The paper leaves open what happens where several targets agree. Here the pair with the least
/// (dd / dist_tolerance)^2 + (da / angle_tolerance)^2 goes first, and a target has one partner at most. Equal
/// pairs are ordered by their ranges and azimuths, then by place, so that the order of the targets has no
/// say.
///
/// Reasons: a detection that lacks azimuth or range is kNoBearing or kRangeUnknown whatever the LiDAR saw.
/// Any other target without partner is judged by its best candidate: one within the tolerances (kTaken),
/// else the one with the least of that sum (the larger of its two terms names the reason), else, of
/// detections without range, the nearest in azimuth. Keeps its buffers from call to call.
class ToleranceMatcher {
 public:
  explicit ToleranceMatcher(const ToleranceParams& params = {}) : params_(params) {}
  void setParams(const ToleranceParams& params) { params_ = params; }

  /// Both sides in the LiDAR's frame. The result stays valid until the next call.
  const Verdicts& run(const std::vector<Polar>& lidar, const std::vector<Polar>& camera);

 private:
  enum class Rank { kWithin, kOutside, kNoRange, kNothing };
  struct Pair {
    int lidar = -1, camera = -1;
    Rank rank = Rank::kNothing;
    double range_difference = kNaN, azimuth_difference = kNaN;
    double range_term = 0.0, azimuth_term = 0.0;  // squared differences over tolerances; 0 unknown
  };

  Pair compare(const Polar& lidar, const Polar& camera) const;
  void rankPairs(const std::vector<Polar>& lidar, const std::vector<Polar>& camera);
  static MatchReason reasonAgainst(const Pair& best);
  static Verdict verdict(const Pair& pair, MatchReason reason, int partner);

  ToleranceParams params_;
  std::vector<Pair> within_, best_of_lidar_, best_of_camera_;
  Verdicts result_;
};

}  // namespace field_fusion::core
