#pragma once
// Where the middle of an upright round body is, of which the near side is seen, or which is seen through.
#include <Eigen/Core>

#include <array>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// What is known before anything is seen. [m]
struct RoundPrior {
  double radius = 0.0;
  double net = 0.0;     ///< radius of a sheer wall inside, 0: none
  double spread = 0.1;  ///< by how much radii differ, as a share
  double noise = 0.03;  ///< standard deviation of a range
};

/// Seen from above, in the LiDAR's frame.
struct RoundFit {
  Eigen::Vector2d centre = Eigen::Vector2d::Constant(kNaN);      ///< [m]
  double radius = kNaN;                                          ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Constant(kNaN);  ///< [m^2] of the centre
};

/// The likeliest of all upright cylinders. A beam towards the cylinder ends at its near side, at either side
/// of the net, or anywhere inside, because the light of one pulse that several surfaces send back counts as
/// one; it ends elsewhere by error only. The radius is within the spread of the nominal one, hardly ever
/// beyond. The near side, the azimuth and the radius are searched, because the near side is known far better
/// than the middle. Of more than 150 points every k-th counts, in the order given. Keeps its buffers.
class RoundFitter {
 public:
  /// At least one point, all finite and none on the axis of the sensor, else NaN.
  RoundFit fit(const std::vector<Point>& points, const RoundPrior& prior);

 private:
  /// Range of the near side [m], azimuth from the middle of the points [rad], radius [m].
  using Guess = Eigen::Array3d;

  bool take(const std::vector<Point>& points);
  std::array<Guess, 3> starts() const;
  Guess climb(Guess guess) const;
  double misfit(const Guess& guess) const;
  Eigen::Matrix2d covarianceAt(const Guess& guess) const;

  RoundPrior prior_;
  std::vector<double> azimuth_, range_;  // of the points, from above; azimuths from `middle_`
  double middle_ = 0.0;                  // [rad]
  double nearest_ = 0.0;                 // [m] what 2 % of the points are nearer than
};

}  // namespace field_fusion::core
