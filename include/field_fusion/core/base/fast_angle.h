#pragma once
#include <algorithm>
#include <cmath>

namespace field_fusion::core {

/// The arctangent of y / x with its quadrant [rad], to 2e-5; 0 at the origin. Without branches, so that a
/// loop over it becomes vectors where the compiler may.
inline float fastAtan2(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float a = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-30f);
  const float s = a * a;
  // odd polynomial on [0, 1], least largest error
  float angle =
      a * (0.99997726f +
           s * (-0.33262347f + s * (0.19354346f + s * (-0.11643287f + s * (0.05265332f - s * 0.01172120f)))));
  angle = ay > ax ? 1.57079633f - angle : angle;
  angle = x < 0.f ? 3.14159265f - angle : angle;
  return y < 0.f ? -angle : angle;
}

}  // namespace field_fusion::core
