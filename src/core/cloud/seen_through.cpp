#include "field_fusion/core/cloud/seen_through.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "field_fusion/core/cloud/dbscan.h"

namespace field_fusion::core {
namespace {

constexpr std::uint32_t kFewTimes = 4;  // an outer set has at least so many times the inner one's points
constexpr float kMargin = 0.15f;        // [m] of the outer set's box

float wrapped(double angle) { return static_cast<float>(std::remainder(angle, 2.0 * radians(180.0))); }

}  // namespace

const std::vector<int>& SeenThrough::run(const Cloud& cloud, const std::vector<int>& labels, int count,
                                         double reach, double depth) {
  reach_ = static_cast<float>(reach), depth_ = static_cast<float>(depth);
  collect(cloud, labels, count);
  for (int outer = 0; outer < count; ++outer)
    for (Set& inner : sets_) {
      if (!mayHold(sets_[outer], inner)) continue;
      prepare(sets_[outer], cloud);
      offer(outer, inner, countEnclosed(sets_[outer], inner, cloud));
    }
  number(labels);
  return labels_;
}

void SeenThrough::offer(int outer, Set& inner, std::uint32_t enclosed) {
  if (2 * enclosed < inner.rays.count || enclosed < inner.enclosed) return;
  const bool tie = enclosed == inner.enclosed && inner.holder >= 0;
  if (tie && sets_[inner.holder].nearest <= sets_[outer].nearest) return;
  inner.holder = outer, inner.enclosed = enclosed;
}

/// A holder has more points than what it holds, so every chain of holders ends.
void SeenThrough::number(const std::vector<int>& labels) {
  place_.assign(sets_.size(), kNoise);
  cluster_count_ = 0;
  labels_ = labels;
  for (int& label : labels_) {
    if (label == kNoise) continue;
    while (sets_[label].holder >= 0) label = sets_[label].holder;
    if (place_[label] == kNoise) place_[label] = cluster_count_++;
    label = place_[label];
  }
}

void SeenThrough::collect(const Cloud& cloud, const std::vector<int>& labels, int count) {
  sets_.assign(static_cast<std::size_t>(count), {});
  for (const int label : labels)
    if (label != kNoise) ++sets_[label].rays.count;
  std::uint32_t first = 0;
  for (Set& set : sets_) {
    set.rays.first = first;
    first += set.rays.count;
    set.rays.count = 0;
  }
  rays_.resize(first);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (labels[i] == kNoise) continue;
    IndexRange& range = sets_[labels[i]].rays;
    rays_[range.first + range.count++].index = i;
  }
  for (Set& set : sets_) measure(set, cloud);
}

void SeenThrough::measure(Set& set, const Cloud& cloud) {
  Ray *begin = rays_.data() + set.rays.first, *end = begin + set.rays.count;
  Eigen::AlignedBox3f box;
  for (const Ray* ray = begin; ray != end; ++ray) box.extend(cloud[ray->index].position());
  const Eigen::Vector3f centre = box.center();
  set.tall = box.sizes().z();
  set.middle = std::atan2(centre.y(), centre.x());
  set.low = set.nearest = std::numeric_limits<float>::infinity();
  set.high = -set.low;
  for (Ray* ray = begin; ray != end; ++ray) {
    const Point& p = cloud[ray->index];
    const float flat2 = p.x * p.x + p.y * p.y;
    ray->azimuth = wrapped(double{std::atan2(p.y, p.x)} - set.middle);
    ray->slope = p.z / std::max(std::sqrt(flat2), 1e-3f);
    ray->range = std::sqrt(flat2 + p.z * p.z);
    set.low = std::min(set.low, ray->azimuth), set.high = std::max(set.high, ray->azimuth);
    set.nearest = std::min(set.nearest, ray->range), set.farthest = std::max(set.farthest, ray->range);
  }
}

/// Few sets hold others, so only those are sorted and get a box.
void SeenThrough::prepare(Set& set, const Cloud& cloud) {
  if (set.ready) return;
  set.ready = true;
  Ray *begin = rays_.data() + set.rays.first, *end = begin + set.rays.count;
  std::sort(begin, end, [](const Ray& a, const Ray& b) {
    return std::tie(a.azimuth, a.slope, a.range) < std::tie(b.azimuth, b.slope, b.range);
  });
  points_.clear();
  for (const Ray* ray = begin; ray != end; ++ray) points_.push_back(cloud[ray->index]);
  set.box = fitter_.fit(points_.data(), points_.size());
}

/// What costs nothing to see.
bool SeenThrough::mayHold(const Set& outer, const Set& inner) const {
  if (outer.rays.count < kFewTimes * inner.rays.count) return false;
  if (inner.farthest < outer.nearest || inner.nearest > outer.farthest + depth_) return false;
  const float turn = wrapped(double{inner.middle} - outer.middle);
  const float side = reach_ / std::max(inner.nearest, reach_);
  return turn + inner.low <= outer.high + side && turn + inner.high >= outer.low - side;
}

std::uint32_t SeenThrough::countEnclosed(const Set& outer, const Set& inner, const Cloud& cloud) const {
  const Ray *begin = rays_.data() + inner.rays.first, *end = begin + inner.rays.count;
  const double turn = double{inner.middle} - outer.middle;
  const bool frames = mayFrame(outer, inner);
  std::uint32_t enclosed = 0;
  for (const Ray* ray = begin; ray != end; ++ray)
    enclosed += encloses(outer, frames, *ray, wrapped(ray->azimuth + turn), cloud[ray->index]);
  return enclosed;
}

/// Of a vehicle with windows, not of a fence with someone behind it.
bool SeenThrough::mayFrame(const Set& outer, const Set& inner) const {
  return inner.tall <= 0.5f * outer.tall && outer.box.size.x() <= 2.f * depth_;
}

/// `azimuth` of the ray, from the middle of the outer set.
bool SeenThrough::encloses(const Set& outer, bool frames, const Ray& ray, float azimuth,
                           const Point& point) const {
  const Ray *begin = rays_.data() + outer.rays.first, *end = begin + outer.rays.count;
  const float side = reach_ / std::max(ray.range, reach_);
  bool in_front = false, higher = false, lower = false;
  const auto before = [](const Ray& a, float b) { return a.azimuth < b; };
  for (const Ray* q = std::lower_bound(begin, end, azimuth - side, before);
       q != end && q->azimuth <= azimuth + side; ++q) {
    if (!(q->range < ray.range && q->range > ray.range - depth_)) continue;
    in_front = true;
    higher |= q->slope > ray.slope;
    lower |= q->slope < ray.slope;
    if (frames && higher && lower) return true;
  }
  return in_front && outer.box.size.y() <= depth_ && outer.box.contains(point.position(), kMargin);
}

}  // namespace field_fusion::core
