#pragma once
// A motion as a uniform B-spline of degree 5, by which an inertial unit's rates and forces can be compared
// with it at any time (Furgale, Barfoot and Sibley 2012: turn and place are six numbers with control points
// of their own).
#include <algorithm>
#include <array>
#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

constexpr int kSplineOrder = 6;  ///< control points that tell a value

/// Evenly spaced segments over time.
struct SplineGrid {
  double begin = 0.0, step = 0.0;  ///< [s]
  int segments = 0;

  /// Covers [begin, end] with segments of about `step`, or one of less.
  static SplineGrid over(double begin, double end, double step) {
    const int segments = std::max(1, static_cast<int>(std::ceil((end - begin) / step)));
    return {begin, (end - begin) / segments, segments};
  }
  int points() const { return segments + kSplineOrder - 1; }
  /// That holds the time, or the nearest. Its control points are those from this index on.
  int segment(double time) const {
    return std::clamp(static_cast<int>(std::floor((time - begin) / step)), 0, segments - 1);
  }
  double start(int segment) const { return begin + step * segment; }
  /// [s] at which a control point counts most.
  double centre(int point) const { return begin + step * (point - 2); }
};

/// Of the six control points: `derivative` 0, 1 or 2 by the time in segments, at `u`, 0 to 1 within one.
template <class T>
std::array<T, kSplineOrder> splineWeights(const T& u, int derivative) {
  static const double kPowers[kSplineOrder][kSplineOrder] = {
      // of 1, u .. u^5, times 120
      {1, -5, 10, -10, 5, -1},    {26, -50, 20, 20, -20, 5}, {66, 0, -60, 0, 30, -10},
      {26, 50, 20, -20, -20, 10}, {1, 5, 10, 10, 5, -5},     {0, 0, 0, 0, 0, 1}};
  std::array<T, kSplineOrder> out;
  for (std::size_t j = 0; j < kSplineOrder; ++j) {
    T sum(0.0);
    for (int power = kSplineOrder - 1; power >= derivative; --power) {
      double factor = kPowers[j][power] / 120.0;
      for (int i = 0; i < derivative; ++i) factor *= power - i;
      sum = sum * u + factor;
    }
    out[j] = sum;
  }
  return out;
}

/// Rotation by the vector `turn`. Templated for automatic differentiation, also at 0.
template <class T>
Eigen::Matrix<T, 3, 3> rotationOf(const Eigen::Matrix<T, 3, 1>& turn) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  Eigen::Matrix<T, 3, 3> k;
  k << T(0.0), -turn.z(), turn.y(), turn.z(), T(0.0), -turn.x(), -turn.y(), turn.x(), T(0.0);
  const T square = turn.squaredNorm();
  T a = 1.0 - square / 6.0, b = 0.5 - square / 24.0;
  if (square > 1e-8) {
    const T angle = sqrt(square);
    a = sin(angle) / angle, b = (1.0 - cos(angle)) / square;
  }
  return Eigen::Matrix<T, 3, 3>::Identity() + a * k + b * k * k;
}

/// [rad/s] in the turned frame, of a rotation vector and its change.
template <class T>
Eigen::Matrix<T, 3, 1> bodyRate(const Eigen::Matrix<T, 3, 1>& turn, const Eigen::Matrix<T, 3, 1>& change) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T square = turn.squaredNorm();
  T a = 0.5 - square / 24.0, b = 1.0 / 6.0 - square / 120.0;
  if (square > 1e-8) {
    const T angle = sqrt(square);
    a = (1.0 - cos(angle)) / square, b = (angle - sin(angle)) / (square * angle);
  }
  const Eigen::Matrix<T, 3, 1> once = turn.cross(change);
  return change - a * once + b * turn.cross(once);
}

/// Sum of control points, each of six numbers (turn, place), as their weights say.
template <class T, class W>
Eigen::Matrix<T, 6, 1> splineSum(const T* const* points, const std::array<W, kSplineOrder>& weights) {
  Eigen::Matrix<T, 6, 1> out = Eigen::Matrix<T, 6, 1>::Zero();
  for (std::size_t j = 0; j < kSplineOrder; ++j)
    for (int i = 0; i < 6; ++i) out[i] += points[j][i] * weights[j];
  return out;
}

}  // namespace field_fusion::core
