#include "field_fusion/core/cloud/filter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

void Filter::setParams(const FilterParams& params) {
  params_ = checked(params);
  const double begin = radians(params_.azimuth_min), end = radians(params_.azimuth_max);
  double width = std::fmod(params_.azimuth_max - params_.azimuth_min, 360.0);
  if (width <= 0.0) width += 360.0;  // 0 too: -180 to 180 is the full circle
  sector_ = {{std::cos(begin), std::sin(begin)},
             {std::cos(end), std::sin(end)},
             width == 360.0   ? Sector::kAll
             : width <= 180.0 ? Sector::kConvex
                              : Sector::kReflex};
  box_ = boxesOf(params_.box);
  body_ = boxesOf(params_.body);
}

bool Filter::Sector::contains(const Point& p) const {
  if (shape == kAll) return true;
  const Eigen::Vector2d at(p.x, p.y);
  const double slack = 1e-7 * at.lpNorm<1>();  // what float32 coordinates can tell apart
  const double after_begin = cross(begin, at), before_end = cross(at, end);
  if (shape == kReflex) return after_begin >= -slack || before_end >= -slack;
  return after_begin >= -slack && before_end >= -slack;
}

bool Filter::passes(const Point& p, const Eigen::Isometry3f& T_box_sensor, FilterCounts& counts) const {
  const auto drop = [](std::size_t& counter) { return ++counter, false; };
  if (!finite(p)) return drop(counts.non_finite);
  if (!sector_.contains(p)) return drop(counts.angle);
  const double range = p.position().cast<double>().norm();
  if (range < params_.min_range || range > params_.max_range) return drop(counts.range);
  if (box_.empty() && body_.empty()) return true;
  const Eigen::Vector3f at = T_box_sensor * p.position();
  const auto inside = [&](const Eigen::AlignedBox3f& box) { return box.contains(at); };
  if (!box_.empty() && !inside(box_.front())) return drop(counts.box);
  if (std::any_of(body_.begin(), body_.end(), inside)) return drop(counts.body);
  return true;
}

FilterCounts Filter::run(const Cloud& cloud, Cloud& kept, const Transform& T_box_sensor) {
  if (!T_box_sensor.matrix().allFinite()) throw std::invalid_argument("T_box_sensor holds NaN or infinity");
  const Eigen::Isometry3f T = T_box_sensor.cast<float>();
  const bool thin = params_.voxel_size > 0.0;
  Cloud& passed = thin ? passed_ : kept;
  FilterCounts counts;
  counts.in = cloud.size();
  passed.clear();
  for (const Point& p : cloud)
    if (passes(p, T, counts)) passed.push_back(p);
  if (thin) voxels_.run(passed_, params_.voxel_size, kept);
  counts.merged = passed.size() - kept.size();
  counts.kept = kept.size();
  return counts;
}

}  // namespace field_fusion::core
