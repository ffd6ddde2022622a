#include "field_fusion/core/cloud/range_image.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

#include "field_fusion/core/cloud/cell_grid.h"
#include "field_fusion/core/cloud/dbscan.h"

namespace field_fusion::core {
namespace {

constexpr double kRowGap = radians(0.1);      // the finest row spacings are just above
constexpr double kRowHeight = radians(0.4);   // of rows that run into each other: that of a 64-row scanner
constexpr double kColumnStep = radians(0.5);  // the coarsest column spacings are just below
constexpr double kRowStep = radians(5.0);
constexpr std::uint32_t kAhead = 12;
constexpr std::uint32_t kAbove = 4;
constexpr std::uint32_t kRowsUp = 2;

/// [rad] Between two azimuths in [-pi, pi]; cheaper than `angleDifference`.
double turn(float a, float b) {
  const double apart = std::abs(double{a} - b);
  return std::min(apart, radians(360.0) - apart);
}

}  // namespace

const std::vector<int>& RangeImage::run(const Cloud& cloud, double epsilon, double theta) {
  if (!(epsilon > 0.0) || !(theta >= 0.0 && theta < radians(90.0)))
    throw std::invalid_argument("range image with epsilon " + std::to_string(epsilon) + " m and theta " +
                                std::to_string(theta) + " rad: above 0, and 0 to below pi / 2 are needed");
  epsilon_ = epsilon;
  same_depth_ = BetaTest(theta);
  collect(cloud);
  if (!rings_known_) findRowsByElevation();
  sortRows();
  const auto count = static_cast<std::uint32_t>(rays_.size());
  sets_.reset(count);
  for (std::uint32_t ray = 0; ray < count; ++ray) {
    joinInRow(cloud, ray);
    joinUpwards(cloud, ray);
  }
  labels_.assign(cloud.size(), kNoise);
  labelPoints();
  return labels_;
}

void RangeImage::collect(const Cloud& cloud) {
  rays_.clear();
  usable_count_ = 0;
  rings_known_ = true;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud[i];
    if (!usable(p)) continue;
    ++usable_count_;
    const float flat2 = p.x * p.x + p.y * p.y, range2 = flat2 + p.z * p.z;
    if (range2 == 0.f) continue;
    rays_.push_back({p.ring, std::atan2(p.y, p.x), std::atan2(p.z, std::sqrt(flat2)), range2, i});
    rings_known_ = rings_known_ && p.ring != kUnknownRing;
  }
}

void RangeImage::findRowsByElevation() {
  std::sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) { return a.elevation < b.elevation; });
  std::uint32_t row = 0;
  float lowest = rays_.empty() ? 0.f : rays_.front().elevation, last = lowest;
  for (Ray& ray : rays_) {
    if (ray.elevation - last > kRowGap || ray.elevation - lowest > kRowHeight) {
      ++row;
      lowest = ray.elevation;
    }
    last = ray.elevation;
    ray.row = row;
  }
}

// Ties are broken by all that tells points apart, so that the result does not depend on their order.
void RangeImage::sortRows() {
  std::sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) {
    return std::tie(a.row, a.azimuth, a.elevation, a.range2, a.index) <
           std::tie(b.row, b.azimuth, b.elevation, b.range2, b.index);
  });
  row_start_.assign(rays_.empty() ? 1 : rays_.back().row + 2, 0);
  for (const Ray& ray : rays_) ++row_start_[ray.row + 1];
  for (std::size_t row = 1; row < row_start_.size(); ++row) row_start_[row] += row_start_[row - 1];
}

void RangeImage::joinIfNear(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  if (sets_.root(a) == sets_.root(b)) return;
  const DepthStep step = depthStep(cloud[rays_[a].index].position(), cloud[rays_[b].index].position());
  const auto near = [&] {
    return turn(rays_[a].azimuth, rays_[b].azimuth) <= kColumnStep || step.acrossWithin(epsilon_);
  };
  if (same_depth_(step) && step.alongWithin(epsilon_) && near()) sets_.join(a, b);
}

void RangeImage::joinInRow(const Cloud& cloud, std::uint32_t ray) {
  const std::uint32_t first = row_start_[rays_[ray].row];
  const std::uint32_t count = row_start_[rays_[ray].row + 1] - first;
  for (std::uint32_t k = 1; k <= kAhead && k < count; ++k)
    joinIfNear(cloud, ray, first + (ray - first + k) % count);
}

void RangeImage::joinUpwards(const Cloud& cloud, std::uint32_t ray) {
  const Ray own = rays_[ray];
  const std::size_t rows = row_start_.size() - 1;
  for (std::size_t row = own.row + 1; row < rows && row <= own.row + kRowsUp; ++row) {
    const std::uint32_t first = row_start_[row], count = row_start_[row + 1] - first;
    if (count == 0) continue;
    const auto begin = rays_.begin() + first;
    const auto after = std::lower_bound(begin, begin + count, own.azimuth,
                                        [](const Ray& r, float azimuth) { return r.azimuth < azimuth; });
    const auto start = static_cast<std::uint32_t>(after - begin) + count * kAbove - kAbove / 2;
    for (std::uint32_t k = 0; k < std::min(kAbove, count); ++k) {
      const std::uint32_t other = first + (start + k) % count;
      if (rays_[other].elevation - own.elevation <= kRowStep) joinIfNear(cloud, ray, other);
    }
  }
}

void RangeImage::labelPoints() {
  cluster_count_ = 0;
  ray_label_.resize(rays_.size());
  for (std::uint32_t ray = 0; ray < rays_.size(); ++ray) {
    const std::uint32_t lowest = sets_.root(ray);  // has its label already, or is this ray
    ray_label_[ray] = lowest == ray ? cluster_count_++ : ray_label_[lowest];
    labels_[rays_[ray].index] = ray_label_[ray];
  }
}

}  // namespace field_fusion::core
