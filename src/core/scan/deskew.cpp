#include "field_fusion/core/scan/deskew.h"

namespace field_fusion::core {
namespace {

Point pointAt(const Eigen::Vector3f& position, const Scan& scan, std::size_t beam) {
  Point out;
  out.x = position.x(), out.y = position.y(), out.z = position.z();
  if (!scan.intensities.empty()) out.intensity = scan.intensities[beam];
  return out;
}

}  // namespace

void ScanDeskewer::updateDirections(const Scan& scan) {
  if (scan.angle_min == angle_min_ && scan.angle_increment == angle_increment_ &&
      scan.ranges.size() == directions_.size())
    return;
  angle_min_ = scan.angle_min;
  angle_increment_ = scan.angle_increment;
  directions_.resize(scan.ranges.size());
  for (std::size_t i = 0; i < directions_.size(); ++i) directions_[i] = scan.direction(i).cast<float>();
}

DeskewCounts ScanDeskewer::run(const Scan& scan, double begin, double time_increment, MotionTrack& track,
                               Scan& binned, Cloud& points) {
  updateDirections(scan);
  const ScanBins bins = ScanBins::about(scan);
  bins.clear(binned, !scan.intensities.empty());
  binned.time_increment = 0.0;
  binned.scan_time = scan.scan_time;
  binned.range_min = 0.0;
  binned.range_max = scan.range_max;
  points.clear();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = reading(scan, i);
    if (std::isnan(range)) continue;
    const auto& pose = track.at(static_cast<float>(begin + static_cast<double>(i) * time_increment));
    if (std::isinf(range)) {
      const Eigen::Vector3f to = pose.rotation * directions_[i];
      mark(binned, bins.at(to.x(), to.y()), range, kNaN);
      continue;
    }
    const Eigen::Vector3f at = pose * (range * directions_[i]);
    points.push_back(pointAt(at, scan, i));
    points.back().time = 0.f;
    const float flat = at.head<2>().norm();
    mark(binned, bins.at(at.x(), at.y()), flat <= static_cast<float>(scan.range_max) ? flat : kFree,
         points.back().intensity);
  }
  DeskewCounts counts;
  counts.returns = points.size();
  for (const float range : binned.ranges) counts.unseen += std::isnan(range);
  return counts;
}

void scanPoints(const Scan& scan, double begin, double time_increment, Cloud& points) {
  points.clear();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = reading(scan, i);
    if (!std::isfinite(range)) continue;
    points.push_back(pointAt(range * scan.direction(i).cast<float>(), scan, i));
    points.back().time = static_cast<float>(begin + static_cast<double>(i) * time_increment);
  }
}

}  // namespace field_fusion::core
