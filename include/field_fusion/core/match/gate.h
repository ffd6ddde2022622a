#pragma once
// Could a cluster and a detection be one body? By how likely their differences are.
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/lidar_target.h"

namespace field_fusion::core {

struct GateParams {
  double gate_probability = 0.997;
  double box_error = 0.05;

  void declare(Params& p) {
    p.number("gate_probability", gate_probability, {0.5, 0.999999}, "", When::kLive,
             "optimal: share of true pairs whose differences in range, azimuth and elevation stay within the "
             "gate.");
    p.number("box_error", box_error, {0.0, 1.0}, "", When::kLive,
             "optimal: standard deviation of the middle of a detector's box over its width or height.");
  }
};

/// The value that a chi-square variable of 2 or 3 degrees of freedom stays below with this probability.
double chiSquareQuantile(double probability, int degrees_of_freedom);

/// How far a detection is from a cluster. `terms` are squared differences over their variances in range
/// (0 where the detection has none), azimuth and elevation, all seen from the camera; their sum is the
/// squared Mahalanobis distance.
struct Likeness {
  Eigen::Array3d terms = Eigen::Array3d::Constant(kNaN);
  double distance2 = kNaN;
  double cost = kNaN;  ///< distance2 plus what the pair owes to a loose fit in size; at most Gate::limit()
  bool inside = false;
};

/// Variances of the differences. Range: that of the detection, the LiDAR's noise, and depth^2 / 12, because
/// the body's centre may lie anywhere in the cluster. Azimuth and elevation: that of the bearing, of the
/// box's middle, and (box - cluster)^2 / 12 with both angular extents: the smaller of the two shows a part of
/// the body that may lie anywhere in the larger. This holds for a body that the LiDAR sees in part, for a
/// cluster of two bodies, and for a box that the image border cuts, whose middle is off by no more than that.
/// Where the box's extent is not known, (cluster extent)^2 / 12.
///
/// A loose fit explains any difference, so that the distance alone would favour it; the cost therefore adds
/// the logarithms of the variances over what they would be without these extents, as the likelihood does.
class Gate {
 public:
  /// `range_sigma` [m] of the LiDAR, `bearing_sigma` [rad] of the detector.
  void setParams(const GateParams& params, double range_sigma, double bearing_sigma);
  double limit() const { return limit3_; }  ///< of distance2 with range: the larger one

  Likeness compare(const Sight& sight, const CameraTarget& target) const;

 private:
  GateParams params_;
  double range_variance_ = 0.0, bearing_variance_ = 0.0;
  double limit2_ = 0.0, limit3_ = 0.0;
};

}  // namespace field_fusion::core
