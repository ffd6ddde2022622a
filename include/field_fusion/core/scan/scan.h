#pragma once
// A planar laser scan and what its numbers mean (REP-117).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// What no sensor saw is free up to range_max (+inf), what stands nearer than it can tell is near (-inf), and
/// what nobody looked at is NaN.
constexpr float kFree = std::numeric_limits<float>::infinity();
constexpr float kNear = -kFree;

/// Beam i points to azimuth angle_min + i * angle_increment in the scanner's x-y plane.
struct Scan {
  double angle_min = 0.0, angle_increment = 0.0;  ///< [rad]; a negative increment is a clockwise scanner
  double time_increment = 0.0;                    ///< [s] between beams; 0: all at one instant
  double scan_time = 0.0;                         ///< [s] between scans; 0: not known
  double range_min = 0.0, range_max = 0.0;        ///< [m]
  std::vector<float> ranges;                      ///< [m]
  std::vector<float> intensities;                 ///< empty, or one a beam

  double angle(std::size_t beam) const { return angle_min + static_cast<double>(beam) * angle_increment; }
  Eigen::Vector3d direction(std::size_t beam) const {
    const double azimuth = angle(beam);
    return {std::cos(azimuth), std::sin(azimuth), 0.0};
  }
};

/// What a beam says: its range, kFree, kNear or NaN. Drivers older than REP-117 send numbers beyond the
/// limits: beyond range_max nothing was seen, below range_min the number is nonsense.
inline float reading(const Scan& scan, std::size_t beam) {
  const float range = scan.ranges[beam];
  if (range > static_cast<float>(scan.range_max)) return kFree;
  return range < static_cast<float>(scan.range_min) && range != kNear ? kNaN : range;
}

/// Empty, or what makes a scan unusable: "scan damaged: ...".
std::string faultOf(const Scan& scan);

/// The beams of a scan that looks all the way round, counter-clockwise. Where the step does not divide the
/// circle, the last bin is narrower.
class ScanBins {
 public:
  /// The first bin about azimuth `first`, `step` [rad] apart.
  ScanBins(double first, double step);
  /// Holds the beams of a scan without fault, in the middle where it does not look all the way round. A
  /// sector alone would lose what turns out of it.
  static ScanBins about(const Scan& scan);

  double first() const { return first_; }  ///< [rad] the middle of its bin
  double step() const { return step_; }    ///< [rad]
  std::size_t size() const { return size_; }

  std::size_t at(float x, float y) const {
    const float place = (std::atan2(y, x) - static_cast<float>(first_)) * per_radian_ + 0.5f;
    return std::min(static_cast<std::size_t>(place - turn_ * std::floor(place / turn_)), size_ - 1);
  }

  /// Writes the angles of a scan, and bins that nobody has looked at.
  void clear(Scan& scan, bool intensities) const;

 private:
  double first_, step_;
  float per_radian_, turn_;  // bins a radian, a circle
  std::size_t size_;
};

/// The nearest wins; anything wins over NaN.
inline void mark(Scan& scan, std::size_t bin, float range, float intensity) {
  float& nearest = scan.ranges[bin];
  if (nearest <= range) return;
  nearest = range;
  if (!scan.intensities.empty()) scan.intensities[bin] = intensity;
}

}  // namespace field_fusion::core
