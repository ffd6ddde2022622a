#include "field_fusion/core/scan/sweep_clock.h"

#include "field_fusion/core/base/median.h"

namespace field_fusion::core {
namespace {

constexpr std::size_t kSpacings = 15, kEnough = 5;
constexpr double kTolerance = 1.2;  // of a duration: stamps jitter

}  // namespace

const char* describe(SweepTiming::Basis basis) {
  switch (basis) {
    case SweepTiming::Basis::kMessage:
      return "time_increment";
    case SweepTiming::Basis::kParameter:
      return "sweep_time";
    case SweepTiming::Basis::kInstant:
      return "time_increment is 0: taken as measured at one instant; if it is not, set sweep_time";
    case SweepTiming::Basis::kSpacing:
      return "time_increment is wrong, scans would overlap: taken as one turn from stamp to stamp";
  }
  return "";
}

void SweepClock::reset() {
  last_.reset();
  spacings_.clear();
  next_ = 0;
}

std::optional<double> SweepClock::spacing() const {
  if (spacings_.size() < kEnough) return std::nullopt;
  return median(spacings_);
}

SweepTiming SweepClock::of(const Scan& scan, double stamp, double sweep_time) {
  if (last_) {
    if (spacings_.size() < kSpacings) spacings_.emplace_back();
    spacings_[next_] = stamp - *last_;
    next_ = (next_ + 1) % kSpacings;
  }
  last_ = stamp;
  const double share = std::abs(scan.angle_increment) / radians(360.0);  // of a turn, a beam
  const double beams = scan.ranges.empty() ? 0.0 : static_cast<double>(scan.ranges.size() - 1);
  const auto apart = spacing();
  SweepTiming out;
  out.time_increment = scan.time_increment;
  if (sweep_time > 0.0) {
    out.basis = SweepTiming::Basis::kParameter;
    out.time_increment = sweep_time * share;
  } else if (scan.time_increment == 0.0) {
    out.basis = SweepTiming::Basis::kInstant;
  } else if (apart && scan.time_increment * beams > kTolerance * *apart) {
    out.basis = SweepTiming::Basis::kSpacing;
    out.time_increment = *apart * share;
  }
  out.scan_time = scan.scan_time;
  out.scan_time_is_wrong =
      scan.scan_time > 0.0 && (kTolerance * scan.scan_time < out.time_increment * beams ||
                               (apart && scan.scan_time > kTolerance * *apart));
  if (out.scan_time_is_wrong) out.scan_time = apart.value_or(0.0);
  return out;
}

}  // namespace field_fusion::core
