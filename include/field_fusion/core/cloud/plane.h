#pragma once
// Planes: the type, the search by random triples (RANSAC) and the fit by least squares.
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// The points p with normal . p + offset = 0. The offset is the height of the frame's origin above the plane.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(kNaN);  ///< unit length
  double offset = kNaN;                                      ///< [m]

  /// [m] above the plane, on the side to which the normal points; negative below.
  double height(const Eigen::Vector3d& p) const { return normal.dot(p) + offset; }
};

/// Least-squares plane of points added one by one.
class PlaneFit {
 public:
  /// `near` [m]: some point among those to come; sums are taken about it to keep their precision.
  explicit PlaneFit(const Eigen::Vector3d& near) : near_(near) {}
  void add(const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - near_;
    sum_ += d, squares_ += d * d.transpose(), ++count_;
  }

  struct Result {
    Plane plane;             ///< the normal's sign is arbitrary
    double thickness = 0.0;  ///< [m] standard deviation of the points along the normal
    double width = 0.0;      ///< [m] the smaller one within the plane; 0 for points on a line
  };
  /// Needs at least one point.
  Result solve() const;

 private:
  Eigen::Vector3d near_, sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  std::size_t count_ = 0;
};

/// Random sample consensus (Fischler, Bolles 1981) scored by truncated squares (MSAC: Torr, Zisserman 2000).
/// The same points and seed give the same plane. Keeps its buffers from search to search.
class PlaneSearch {
 public:
  static constexpr std::size_t kMostSamples = 3000;

  /// Judges a plane through three points; may turn its normal round. Refused planes cost no scoring.
  using Accept = std::function<bool(Plane&)>;

  /// Sets the candidates: a sample of at most kMostSamples of the cloud's points listed in `usable`.
  void sample(const Cloud& cloud, const std::vector<std::uint32_t>& usable, unsigned seed);

  /// Best accepted plane within `distance` [m] of the sample, in at most `tries` triples and fewer once a
  /// better one is 99.9 % unlikely. False when no triple spanned an accepted plane.
  bool run(double distance, int tries, const Accept& accept, Plane& best);

 private:
  Eigen::Vector3d draw();
  double score(const Plane& plane, float distance) const;

  std::mt19937 random_;
  std::vector<float> xs_, ys_, zs_;
};

}  // namespace field_fusion::core
