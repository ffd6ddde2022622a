#include "field_fusion/core/match/round_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace field_fusion::core {
namespace {

constexpr std::size_t kSample = 150;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Shares of the beams that end at the near side, at the near and the far side of the net, and inside.
struct Shares {
  double outside, net, far_net, inside;
};
constexpr Shares kSolid{0.5, 0.0, 0.0, 0.4}, kOpen{0.1, 0.4, 0.1, 0.4};
/// Density of what goes past, per radius: close to the cylinder, and anywhere.
constexpr double kPast = 0.3, kAnywhere = 1e-4;

double bell(double error, double sigma) {
  const double x = error / sigma;
  return std::abs(x) > 10.0 ? 0.0 : std::exp(-0.5 * x * x) / (sigma * 2.5066);
}

}  // namespace

RoundFit RoundFitter::fit(const std::vector<Point>& points, const RoundPrior& prior) {
  RoundFit out;
  prior_ = prior;
  if (!take(points)) return out;
  Guess best = Guess::Zero();
  double least = kInfinity;
  for (const Guess& start : starts()) {
    const Guess guess = climb(start);
    const double value = misfit(guess);
    if (value < least) least = value, best = guess;
  }
  if (!std::isfinite(least)) return out;
  const double azimuth = middle_ + best[1];
  out.radius = best[2];
  out.centre = (best[0] + best[2]) * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
  out.covariance = covarianceAt(best);
  return out;
}

bool RoundFitter::take(const std::vector<Point>& points) {
  range_.clear(), azimuth_.clear();
  const std::size_t step = (points.size() + kSample - 1) / kSample;
  double low = kInfinity, high = -kInfinity;
  if (points.empty()) return false;
  const double first = middle_ = std::atan2(points[0].y, points[0].x);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Point& p = points[i];
    range_.push_back(std::hypot(p.x, p.y));
    azimuth_.push_back(angleDifference(std::atan2(p.y, p.x), first));
    low = std::min(low, azimuth_.back()), high = std::max(high, azimuth_.back());
    if (!(range_.back() > 0.0 && range_.back() < kInfinity)) return false;
  }
  const double shift = 0.5 * (low + high);
  for (double& azimuth : azimuth_) azimuth -= shift;
  middle_ += shift;
  std::vector<double> sorted = range_;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 50);
  std::nth_element(sorted.begin(), place, sorted.end());
  nearest_ = *place;
  return true;
}

/// The best of a grid: the near side before what is seen, as where that is the net, to behind it.
std::array<RoundFitter::Guess, 3> RoundFitter::starts() const {
  std::vector<std::pair<double, Guess>> tried;
  for (int step = -6; step <= 3; ++step)
    for (const double size : {1.0 - prior_.spread, 1.0, 1.0 + prior_.spread}) {
      const Guess guess(nearest_ + 0.1 * step * prior_.radius, 0.0, size * prior_.radius);
      tried.emplace_back(misfit(guess), guess);
    }
  std::partial_sort(tried.begin(), tried.begin() + 3, tried.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  return {tried[0].second, tried[1].second, tried[2].second};
}

/// Along one axis at a time, by steps that are halved where none is better.
RoundFitter::Guess RoundFitter::climb(Guess guess) const {
  constexpr int kHalvings = 6;
  const double radius = prior_.radius;
  Guess step(0.1 * radius, 0.1 * radius / (nearest_ + radius), 0.05 * radius);
  double least = misfit(guess);
  const auto better = [&](int axis, double sign) {
    Guess other = guess;
    other[axis] += sign * step[axis];
    const double value = misfit(other);
    if (!(value < least)) return false;
    least = value, guess = other;
    return true;
  };
  for (int halved = 0; halved <= kHalvings;) {
    bool moved = false;
    for (int axis = 0; axis < 3; ++axis) moved |= better(axis, 1.0) || better(axis, -1.0);
    if (!moved) ++halved, step /= 2.0;
  }
  return guess;
}

/// Negative logarithm of the likelihood.
double RoundFitter::misfit(const Guess& guess) const {
  const auto [near, turn, radius] = std::tie(guess[0], guess[1], guess[2]);
  if (!(near > 0.0 && radius > 0.5 * prior_.radius)) return kInfinity;
  const double noise = prior_.noise, size = prior_.radius, net = radius * prior_.net / size;
  const Shares& shares = net > 0.0 ? kOpen : kSolid;
  double sum = 0.0;
  for (std::size_t i = 0; i < range_.size(); ++i) {
    const double aside = std::abs((near + radius) * std::sin(azimuth_[i] - turn));
    const double behind = range_[i] - (near + radius) * std::cos(azimuth_[i] - turn);
    double density = kAnywhere / size, half = 0.0;
    if (aside < radius) {
      half = std::sqrt(radius * radius - aside * aside);
      density += shares.outside * bell(behind + half, noise);
      if (std::abs(behind) < half) density += shares.inside / size;
    }
    if (aside < net) {
      const double depth = std::sqrt(net * net - aside * aside);
      density += shares.net * bell(behind + depth, noise) + shares.far_net * bell(behind - depth, noise);
    }
    const double past = std::hypot(std::max(0.0, aside - radius), std::max(0.0, std::abs(behind) - half));
    density += kPast / size * std::exp(-past / noise);
    sum -= std::log(density);
  }
  return sum + 0.5 * std::pow((radius / size - 1.0) / (0.8 * prior_.spread), 4);
}

/// By the curvature of the misfit. Errors of points are not independent (the bias of a row is one): the
/// variance is taken as four times what the curvature says, and no less than the noise allows.
Eigen::Matrix2d RoundFitter::covarianceAt(const Guess& guess) const {
  const double distance = guess[0] + guess[2], step = 0.02 * prior_.radius;
  const Guess steps(step, step / distance, step);
  const auto at = [&](int i, double a, int k, double b) {
    Guess other = guess;
    other[i] += a * steps[i], other[k] += b * steps[k];
    return misfit(other);
  };
  Eigen::Matrix3d curvature;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      curvature(i, k) =
          (at(i, 0.5, k, 0.5) - at(i, 0.5, k, -0.5) - at(i, -0.5, k, 0.5) + at(i, -0.5, k, -0.5)) /
          (steps[i] * steps[k]);
  Eigen::Matrix<double, 2, 3> to_centre;  // along the line of sight, and to its left
  to_centre << 1, 0, 1, 0, distance, 0;
  const double floor = prior_.noise * prior_.noise, size = prior_.spread * prior_.radius;
  Eigen::Matrix2d covariance = Eigen::Vector2d(size * size, 0.0).asDiagonal();
  if (const Eigen::LLT<Eigen::Matrix3d> solved(curvature); solved.info() == Eigen::Success)
    covariance = 4.0 * to_centre * solved.solve(to_centre.transpose());
  covariance += floor * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(middle_ + guess[1]).toRotationMatrix();
  return turn * covariance * turn.transpose();
}

}  // namespace field_fusion::core
