#pragma once
// Does a camera still look where its calibration says? By how far boxes lie from their clusters on average.
#include <Eigen/Core>

#include <deque>
#include <optional>

#include "field_fusion/core/base/params.h"

namespace field_fusion::core {

struct AlignmentParams {
  double drift_floor = 0.3;

  void declare(Params& p) {
    p.number("drift_floor", drift_floor, {0.0, 45.0}, "deg", When::kLive,
             "A shift of the mean difference between clusters and boxes that is never called a drift. Beyond, "
             "it is one where it exceeds three standard deviations of what it was at the start.");
  }
};

/// The means of single seconds are what is kept, since errors of one body are alike from frame to frame. The
/// first 60 seconds with pairs tell what is usual: bodies that are seen in part, and a calibration that is
/// not perfect, leave a mean and a spread. The mean of the last 30 is compared with it.
/// Angles are azimuth and elevation, LiDAR minus camera [rad].
class AlignmentWatch {
 public:
  static constexpr int kUsual = 60, kLast = 30;  ///< seconds

  struct Drift {
    Eigen::Array2d usual, now;  ///< means
    Eigen::Array2d deviation;   ///< of the usual seconds
  };

  /// Of one matched pair; not finite: not known, left out. Stamps [s] must not fall.
  void add(double stamp, const Eigen::Array2d& difference);
  std::optional<Drift> drift() const;  ///< nothing before there are enough seconds
  static bool isFault(const Drift& drift, const AlignmentParams& params);

 private:
  void close();

  double second_ = 0.0;  // the one that is being summed
  int count_ = 0;
  Eigen::Array2d sum_ = Eigen::Array2d::Zero();
  int usual_count_ = 0;
  Eigen::Array2d usual_sum_ = Eigen::Array2d::Zero(), usual_squares_ = Eigen::Array2d::Zero();
  std::deque<Eigen::Array2d> last_;
};

}  // namespace field_fusion::core
