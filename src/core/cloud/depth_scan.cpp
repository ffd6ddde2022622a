#include "field_fusion/core/cloud/depth_scan.h"

#include <cmath>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/fast_angle.h"
#include "field_fusion/core/cloud/depth_points.h"

namespace field_fusion::core {

void DepthScanner::setParams(const DepthScanParams& params) {
  params_ = checked(params);
  bins_ = ScanBins(radians(-180.0), radians(params.azimuth_step));
  cells_ =
      static_cast<std::size_t>(std::ceil((params.range_max - params.range_min) / params.cell_length)) + 1;
  body_ = boxesOf(params.body);
  body_reach_ = 0.f;
  for (const auto& box : body_)
    body_reach_ = std::max({body_reach_, box.min().norm(), box.max().norm(), box.sizes().norm()});
}

void DepthScanner::begin(const ScanPlace& place, std::size_t batch) {
  for (auto* numbers : {&x_, &y_, &z_, &range_}) numbers->resize(batch);
  beam_.resize(batch);
  grid_.assign(bins_.size() * cells_, {kFree, 0});
  seen_.assign(bins_.size(), 0);
  T_base_plane_ = place.T_plane_base.inverse().cast<float>();
  own_range_ = body_.empty() ? 0.f : body_reach_ + T_base_plane_.translation().norm();
  low_ = static_cast<float>(params_.min_height - place.plane_height);
  high_ = static_cast<float>(params_.max_height - place.plane_height);
  slope_ = static_cast<float>(std::tan(radians(params_.floor_angle)));
  counts_ = {};
}

// Most of the time goes into this loop, which the compiler turns into vectors.
void DepthScanner::addBatch(std::size_t count) {
  const auto per_radian = static_cast<float>(1.0 / bins_.step());
  const auto last = static_cast<std::uint32_t>(bins_.size() - 1);
  const float first = static_cast<float>(bins_.first());
  const float *x = x_.data(), *y = y_.data();
  float* range = range_.data();
  std::uint32_t* beam = beam_.data();
  for (std::size_t i = 0; i < count; ++i) {
    range[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    const auto place = static_cast<std::int32_t>((fastAtan2(y[i], x[i]) - first) * per_radian + 0.5f);
    beam[i] = static_cast<std::uint32_t>(place) > last ? 0 : static_cast<std::uint32_t>(place);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (z_[i] == z_[i]) add(x_[i], y_[i], z_[i], range_[i], beam_[i]);
}

void DepthScanner::add(float x, float y, float z, float range, std::size_t beam) {
  ++counts_.seen;
  const auto drop = [&](std::size_t& counter) { ++counter, seen_[beam] = 1; };
  if (z < low_ + slope_ * range) return drop(counts_.floor);
  if (z > high_) return drop(counts_.above);
  const float first = static_cast<float>(params_.range_min);
  if (range < first) return void(++counts_.out_of_range);
  if (range > static_cast<float>(params_.range_max)) return drop(counts_.out_of_range);
  if (range < own_range_) {
    const Eigen::Vector3f at = T_base_plane_ * Eigen::Vector3f(x, y, z);
    for (const auto& box : body_)
      if (box.contains(at)) return void(++counts_.body);
  }
  ++counts_.kept;
  const auto cell = static_cast<std::size_t>((range - first) / static_cast<float>(params_.cell_length));
  Cell& into = grid_[beam * cells_ + std::min(cell, cells_ - 1)];
  into.nearest = std::min(into.nearest, range);
  ++into.count;
}

DepthScanCounts DepthScanner::finish(Scan& scan) {
  bins_.clear(scan, false);
  scan.time_increment = scan.scan_time = 0.0;
  scan.range_min = params_.range_min;
  scan.range_max = params_.range_max;
  const auto fewest = static_cast<std::uint32_t>(params_.min_points);
  for (std::size_t beam = 0; beam < bins_.size(); ++beam) {
    if (seen_[beam]) scan.ranges[beam] = kFree;
    for (std::size_t i = beam * cells_; i < (beam + 1) * cells_; ++i) {
      if (grid_[i].count == 0) continue;
      if (grid_[i].count >= fewest) {
        scan.ranges[beam] = grid_[i].nearest;
        break;
      }
      counts_.noise += grid_[i].count;
    }
  }
  return counts_;
}

template <class Pixel>
DepthScanCounts DepthScanner::runImage(const DepthImage<Pixel>& image, const ScanPlace& place, Scan& scan) {
  const auto width = static_cast<std::size_t>(image.width);
  begin(place, width);
  // the ray of a pixel, carried into the plane, is the sum of a part of its column and one of its row
  const Eigen::Matrix3f R = place.T_plane_sensor.linear().cast<float>();
  const Eigen::Vector3f t = place.T_plane_sensor.translation().cast<float>();
  columns_.resize(width);
  for (std::size_t u = 0; u < width; ++u)
    columns_[u] = R.col(0) * static_cast<float>((static_cast<double>(u) - image.cx) / image.fx);
  for (int v = 0; v < image.height; ++v) {
    const Eigen::Vector3f row = R.col(2) + R.col(1) * static_cast<float>((v - image.cy) / image.fy);
    const Pixel* pixel = image.pixels + static_cast<std::size_t>(v) * image.row;
    for (std::size_t u = 0; u < width; ++u) {
      const float depth = depthMetres(pixel[u]);
      x_[u] = t.x() + depth * (row.x() + columns_[u].x());
      y_[u] = t.y() + depth * (row.y() + columns_[u].y());
      z_[u] = depth > 0.f ? t.z() + depth * (row.z() + columns_[u].z()) : kNaN;
    }
    addBatch(width);
  }
  return finish(scan);
}

DepthScanCounts DepthScanner::run(const DepthImage<std::uint16_t>& image, const ScanPlace& place,
                                  Scan& scan) {
  return runImage(image, place, scan);
}

DepthScanCounts DepthScanner::run(const DepthImage<float>& image, const ScanPlace& place, Scan& scan) {
  return runImage(image, place, scan);
}

DepthScanCounts DepthScanner::run(const Cloud& cloud, const ScanPlace& place, Scan& scan) {
  constexpr std::size_t kBatch = 1024;
  begin(place, kBatch);
  const Eigen::Isometry3f T = place.T_plane_sensor.cast<float>();
  for (std::size_t first = 0; first < cloud.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, cloud.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f at = T * cloud[first + i].position();
      const bool known = at.allFinite();
      x_[i] = known ? at.x() : 0.f, y_[i] = known ? at.y() : 0.f, z_[i] = known ? at.z() : kNaN;
    }
    addBatch(count);
  }
  return finish(scan);
}

}  // namespace field_fusion::core
