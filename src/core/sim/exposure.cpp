#include "field_fusion/core/sim/exposure.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core::sim {
namespace {

constexpr double kShortest = 2e-5;  // [s]

double factor(double decibel) { return std::pow(10.0, decibel / 20.0); }

}  // namespace

Exposure::Exposure(const CameraParams& p)
    : automatic_(p.auto_exposure),
      wanted_(p.brightness),
      delay_(p.exposure_delay),
      longest_(1e-3 * p.max_exposure_time),
      highest_(factor(p.max_gain)),
      white_time_(1e-3 * p.white_time),
      time_(1e-3 * p.exposure_time),
      gain_(factor(p.gain)) {}

void Exposure::follow(double mean, double later) {
  if (!automatic_ || !std::isfinite(mean)) return;
  constexpr double kMost = 16.0;  // a picture that is all black or white says no more
  const double ratio = std::clamp(wanted_ / std::max(mean, 1e-6), 1.0 / kMost, kMost);
  const double share = delay_ > 0.0 ? 1.0 - std::exp(-std::max(0.0, later) / delay_) : 1.0;
  set(scale() * std::pow(ratio, share));
}

void Exposure::set(double scale) {
  const double light = scale * white_time_;
  time_ = std::clamp(light, std::min(kShortest, longest_), longest_);
  gain_ = std::clamp(light / time_, 1.0, highest_);
}

}  // namespace field_fusion::core::sim
