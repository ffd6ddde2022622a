#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {
namespace {

constexpr double kCircle = radians(360.0);
constexpr double kFinestStep = kCircle / 1e5;  // a smaller one asks for memory without end

bool nonNegative(double value) { return std::isfinite(value) && value >= 0.0; }

}  // namespace

std::string faultOf(const Scan& scan) {
  const std::string damaged = "scan damaged: ";
  const double step = std::abs(scan.angle_increment);
  if (!std::isfinite(scan.angle_min)) return damaged + "angle_min is not finite";
  if (!(step >= kFinestStep && step <= 0.5 * kCircle))
    return damaged + "angle_increment is " + std::to_string(scan.angle_increment) + " rad";
  if (static_cast<double>(scan.ranges.size()) * step > kCircle + 2.5 * step)
    return damaged + std::to_string(scan.ranges.size()) + " beams are more than a turn";
  if (!nonNegative(scan.time_increment))
    return damaged + "time_increment is " + std::to_string(scan.time_increment) + " s";
  if (!nonNegative(scan.scan_time)) return damaged + "scan_time is " + std::to_string(scan.scan_time) + " s";
  if (!nonNegative(scan.range_min) || !(scan.range_min < scan.range_max))
    return damaged + "range_min is " + std::to_string(scan.range_min) + ", range_max " +
           std::to_string(scan.range_max) + " m";
  if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
    return damaged + std::to_string(scan.intensities.size()) + " intensities for " +
           std::to_string(scan.ranges.size()) + " ranges";
  return "";
}

ScanBins::ScanBins(double first, double step) : first_(first), step_(step) {
  const double bins = kCircle / step;
  const double whole = std::round(bins);
  if (std::abs(bins - whole) < 0.01) step_ = kCircle / whole;  // a driver's rounding
  size_ = static_cast<std::size_t>(std::ceil(kCircle / step_ - 1e-6));
  per_radian_ = static_cast<float>(1.0 / step_);
  turn_ = static_cast<float>(kCircle / step_);
}

ScanBins ScanBins::about(const Scan& scan) {
  const bool clockwise = scan.angle_increment < 0.0;
  const double first =
      clockwise && !scan.ranges.empty() ? scan.angle(scan.ranges.size() - 1) : scan.angle_min;
  ScanBins bins(first, std::abs(scan.angle_increment));
  const std::size_t beams = scan.ranges.size();
  if (beams < bins.size_) bins.first_ -= static_cast<double>((bins.size_ - beams) / 2) * bins.step_;
  return bins;
}

void ScanBins::clear(Scan& scan, bool intensities) const {
  scan.angle_min = first_;
  scan.angle_increment = step_;
  scan.ranges.assign(size_, kNaN);
  scan.intensities.assign(intensities ? size_ : 0, kNaN);
}

}  // namespace field_fusion::core
