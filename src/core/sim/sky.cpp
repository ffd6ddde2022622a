#include "sky.h"

#include <algorithm>
#include <cmath>

#include "texture.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kSunRadius = 0.00465f;  // [rad]

Eigen::Vector3f tinted(float brightness, const Eigen::Vector3f& tint) {
  return brightness / luminance(tint) * tint;
}

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
  return t * t * (3.f - 2.f * t);
}

/// 0..1, clouds on a plane far above.
float cloudAt(const Eigen::Vector3f& d, const Light& light) {
  if (d.z() < 0.03f || light.clouds == 0.0) return 0.f;  // the noise has rare peaks above any edge
  const float spread = 1.6f / (static_cast<float>(light.cloud_size) * (d.z() + 0.12f));
  const float layer = 7.5f + 11.3f * static_cast<float>(light.cloud_seed);
  const float noise = smoothNoise({spread * d.x(), 1.4f * spread * d.y(), layer}, 4, 0.f);
  const float edge = 1.f - static_cast<float>(light.clouds);
  return smoothStep(edge, edge + 0.3f, noise) * smoothStep(0.03f, 0.2f, d.z());
}

/// Colour of the sky's light on a level sheet: the whiter the more clouds.
Eigen::Vector3f diffuse(const Light& light) {
  const Eigen::Vector3f clear = 0.9f * light.zenith + 0.1f * light.horizon;
  const float white = 0.36f + 0.64f * static_cast<float>(light.clouds);
  return (1.f - white) / luminance(clear) * clear + Eigen::Vector3f::Constant(white);
}

}  // namespace

Sky::Sky(const Light& light)
    : to_sun_(light.to_sun.normalized().cast<float>()),
      sun_(tinted(static_cast<float>(light.sun), light.sun_colour)),
      ambient_(tinted(static_cast<float>(light.sky), diffuse(light))) {
  // Seen by a level sheet, horizon's share (1 - z)^3 of the gradient counts 1/10.
  const float scale = static_cast<float>(light.sky) / luminance(0.9f * light.zenith + 0.1f * light.horizon);
  zenith_ = scale * light.zenith, horizon_ = scale * light.horizon;
  clouds_.reserve(kSide * kSide);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float x = 2.f * i / (kSide - 1) - 1.f, y = 2.f * j / (kSide - 1) - 1.f, r2 = x * x + y * y;
      clouds_.push_back(cloudAt(Eigen::Vector3f(2 * x, 2 * y, 1 - r2) / (1 + r2), light));
    }
}

float Sky::clouds(const Eigen::Vector3f& d) const {
  if (d.z() <= 0.f) return 0.f;
  const float scale = 0.5f * (kSide - 1) / (1.f + d.z());
  const float x = std::clamp(scale * (d.x() + 1.f + d.z()), 0.f, kSide - 1.001f);
  const float y = std::clamp(scale * (d.y() + 1.f + d.z()), 0.f, kSide - 1.001f);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
  const float* c = &clouds_[static_cast<std::size_t>(j * kSide + i)];
  return (1 - t) * ((1 - s) * c[0] + s * c[1]) + t * ((1 - s) * c[kSide] + s * c[kSide + 1]);
}

Eigen::Vector3f Sky::radiance(const Eigen::Vector3f& d) const {
  const float low = 1.f - std::clamp(d.z(), 0.f, 1.f);
  Eigen::Vector3f out = zenith_ + low * low * low * (horizon_ - zenith_);
  const float cloud = clouds(d);
  if (cloud > 0.f) out += 0.8f * cloud * (1.3f * Eigen::Vector3f::Constant(luminance(horizon_)) - out);
  const float away = 1.f - d.dot(to_sun_);
  if (away < 0.3f) out += (0.12f * std::exp(-20.f * away) + 1.2f * std::exp(-400.f * away)) * sun_;
  return out;
}

Eigen::Vector3f Sky::withSun(const Eigen::Vector3f& d) const {
  constexpr float kArea = kSunRadius * kSunRadius;  // sin^2: its irradiance is that of a white sheet
  const bool inside = (d - to_sun_).squaredNorm() < kArea;
  return inside ? Eigen::Vector3f(radiance(d) + sun_ / kArea) : radiance(d);
}

Eigen::Vector3f Sky::ambient(const Eigen::Vector3f& normal, const Eigen::Vector3f& bounce) const {
  const float up = 0.5f + 0.5f * normal.z();
  return up * ambient_ + (1.f - up) * bounce;
}

}  // namespace field_fusion::core::sim
