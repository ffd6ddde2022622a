#include "field_fusion/core/cloud/plane.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

/// Below this sine of the angle at its first point a triple says too little about the normal.
constexpr double kFlattestTriple = 0.01;

/// Even choice of 0 ... n - 1; unlike std::uniform_int_distribution the same with every library.
std::size_t below(std::mt19937& random, std::size_t n) { return std::uint64_t{random()} * n >> 32; }

bool through(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, Plane& plane) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (!(length > kFlattestTriple * (b - a).norm() * (c - a).norm())) return false;
  plane.normal = normal / length;
  plane.offset = -plane.normal.dot(a);
  return true;
}

/// Triples after which one of three good points was drawn with 99.9 % likelihood.
double triplesNeeded(double good_share) {
  const double all_good = std::pow(std::clamp(good_share, 1e-3, 1.0 - 1e-3), 3.0);
  return std::log(0.001) / std::log1p(-all_good);
}

}  // namespace

PlaneFit::Result PlaneFit::solve() const {
  const Eigen::Vector3d mean = sum_ / static_cast<double>(count_);
  const Eigen::Matrix3d covariance = squares_ / static_cast<double>(count_) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  const Eigen::Vector3d deviation = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector3d normal = axes.eigenvectors().col(0);
  return {{normal, -normal.dot(near_ + mean)}, deviation[0], deviation[1]};
}

// One point out of each of equal stretches: a plain stride would meet the same rings again and again.
void PlaneSearch::sample(const Cloud& cloud, const std::vector<std::uint32_t>& usable, unsigned seed) {
  random_.seed(seed);
  xs_.clear(), ys_.clear(), zs_.clear();
  const std::size_t n = usable.size(), count = std::min(n, kMostSamples);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t first = k * n / count, last = (k + 1) * n / count;
    const Point& p = cloud[usable[first + below(random_, last - first)]];
    xs_.push_back(p.x), ys_.push_back(p.y), zs_.push_back(p.z);
  }
}

Eigen::Vector3d PlaneSearch::draw() {
  const std::size_t i = below(random_, xs_.size());
  return {xs_[i], ys_[i], zs_[i]};
}

/// Share of the sample on the plane; a point counts the less the farther off it is, down to 0 at `distance`.
double PlaneSearch::score(const Plane& plane, float distance) const {
  using Values = Eigen::Map<const Eigen::ArrayXf>;
  const auto size = static_cast<Eigen::Index>(xs_.size());
  const Values x(xs_.data(), size), y(ys_.data(), size), z(zs_.data(), size);
  const Eigen::Vector3f n = plane.normal.cast<float>() / distance;
  const float offset = static_cast<float>(plane.offset) / distance;
  return (1.f - (n.x() * x + n.y() * y + n.z() * z + offset).square()).max(0.f).mean();
}

bool PlaneSearch::run(double distance, int tries, const Accept& accept, Plane& best) {
  if (xs_.size() < 3) return false;
  double best_score = -1.0, needed = tries;
  for (int t = 0; t < tries && t < needed; ++t) {
    Plane plane;
    const Eigen::Vector3d a = draw(), b = draw(), c = draw();
    if (!through(a, b, c, plane) || !accept(plane)) continue;
    const double score = this->score(plane, static_cast<float>(distance));
    if (score <= best_score) continue;
    best = plane, best_score = score;
    needed = triplesNeeded(score);
  }
  return best_score >= 0.0;
}

}  // namespace field_fusion::core
