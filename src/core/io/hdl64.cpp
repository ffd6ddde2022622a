#include "field_fusion/core/io/hdl64.h"

#include <algorithm>
#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

std::uint16_t hdl64Ring(double elevation) {
  constexpr int kBlock = 32;
  constexpr double kLowest = -73.0 / 3.0, kLowerStep = 0.5;           // deg
  constexpr double kUpperLowest = -25.0 / 3.0, kUpperStep = 1.0 / 3;  // deg
  constexpr double kBetween = 0.5 * (kLowest + (kBlock - 1) * kLowerStep + kUpperLowest);
  if (std::isnan(elevation)) return kUnknownRing;

  const double angle = degrees(elevation);
  const bool upper = angle >= kBetween;
  const double row = upper ? (angle - kUpperLowest) / kUpperStep : (angle - kLowest) / kLowerStep;
  const double clamped = std::clamp(std::round(row), 0.0, kBlock - 1.0);
  return static_cast<std::uint16_t>(clamped + (upper ? kBlock : 0));
}

float turnTime(double azimuth, double turn) {
  return static_cast<float>(turn * angleDifference(azimuth, 0.0) / radians(360.0));
}

}  // namespace field_fusion::core
