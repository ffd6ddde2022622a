#include "field_fusion/core/scan/merge.h"

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core {
namespace {

constexpr double kCircle = radians(360.0);

}  // namespace

void ScanMerger::setParams(const MergeParams& params) {
  params_ = checked(params);
  const double sector = params.azimuth_max - params.azimuth_min;
  const double steps = std::ceil(sector / params.azimuth_step - 1e-9);
  out_.angle_min = radians(params.azimuth_min);
  out_.angle_increment = radians(sector) / steps;
  out_.range_min = params.range_min;
  out_.range_max = params.range_max;
  round_ = sector == 360.0;  // the last beam is not the first again
  out_.ranges.resize(static_cast<std::size_t>(steps) + (round_ ? 0 : 1));
}

void ScanMerger::begin(double plane_height) {
  std::fill(out_.ranges.begin(), out_.ranges.end(), kNaN);
  low_ = params_.min_height - plane_height;
  high_ = params_.max_height - plane_height;
  counts_ = {};
}

std::size_t ScanMerger::binOf(double azimuth) const {
  const double turned =
      std::fmod(azimuth - out_.angle_min + 0.5 * out_.angle_increment + 2.0 * kCircle, kCircle);
  const auto bin = static_cast<std::size_t>(turned / out_.angle_increment);
  return round_ ? std::min(bin, out_.ranges.size() - 1) : bin;
}

void ScanMerger::addReturn(const Eigen::Vector3d& at) {
  ++counts_.returns;
  if (at.z() < low_) return void(++counts_.floor);
  if (at.z() > high_) return void(++counts_.above);
  const double range = at.head<2>().norm();
  const std::size_t bin = binOf(std::atan2(at.y(), at.x()));
  if (!(range >= params_.range_min && range <= params_.range_max) || bin >= out_.ranges.size())
    return void(++counts_.out_of_range);
  ++counts_.merged;
  float& nearest = out_.ranges[bin];
  if (!(std::isfinite(nearest) && nearest <= range)) nearest = static_cast<float>(range);
}

void ScanMerger::addLook(float reading, double from, double to) {
  for (double azimuth = from; azimuth <= to; azimuth += out_.angle_increment) {
    const std::size_t bin = binOf(azimuth);
    if (bin >= out_.ranges.size()) continue;
    float& known = out_.ranges[bin];
    if (std::isnan(known) || (known == kFree && reading == kNear)) known = reading;
  }
}

void ScanMerger::add(const Scan& scan, const Transform& T_plane_scanner) {
  const Eigen::Matrix3d R = T_plane_scanner.linear();
  const bool sees_far = scan.range_max >= params_.range_max;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = reading(scan, i);
    if (std::isnan(range)) continue;
    const Eigen::Vector3d direction = scan.direction(i);
    if (std::isfinite(range)) {
      addReturn(T_plane_scanner * (range * direction));
      continue;
    }
    if (range == kFree && !sees_far) continue;
    // a free beam is as wide as its step; far out, where the scanner stands does not matter
    const Eigen::Vector3d to = R * direction;
    const double azimuth = std::atan2(to.y(), to.x());
    const double half = std::max(0.0, 0.5 * (std::abs(scan.angle_increment) - out_.angle_increment));
    addLook(range, azimuth - half, azimuth + half);
  }
}

}  // namespace field_fusion::core
