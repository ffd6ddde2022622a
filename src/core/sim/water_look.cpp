#include "water_look.h"

#include <algorithm>
#include <cmath>

#include "random.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kPi = 3.14159265f;
/// Variance of the slope in a breeze of 3 m/s: 0.003 + 0.00512 U (Cox and Munk 1954).
constexpr float kVariance = 0.018f;

/// Schlick 1994, for water of index 1.33.
float fresnel(float cosine) {
  const float c = 1.f - std::clamp(cosine, 0.f, 1.f), c2 = c * c;
  return 0.02f + 0.98f * c2 * c2 * c;
}

/// Radiance of the sun on a rough surface (Cox and Munk 1954, Eq. 9) over that of a white sheet: the slope
/// that mirrors the sun occurs by a normal distribution about the mean one.
float glitterOf(const Eigen::Vector3f& view, const Eigen::Vector3f& to_sun, const Eigen::Vector3f& normal,
                float variance) {
  const Eigen::Vector3f half = (view + to_sun).normalized();
  if (half.z() < 0.2f || to_sun.z() <= 0.f) return 0.f;
  const Eigen::Vector2f off = half.head<2>() / half.z() - normal.head<2>() / normal.z();
  const float density = std::exp(-off.squaredNorm() / variance) / (kPi * variance);
  const float z2 = half.z() * half.z();
  return fresnel(half.dot(view)) * kPi * density / (4.f * std::max(0.05f, view.dot(normal)) * z2 * z2);
}

}  // namespace

Ripples::Ripples() {
  constexpr double kGravity = 9.80665;
  for (int i = 0; i < kWaves; ++i) {
    const double length = 0.12 * std::pow(2.4 / 0.12, (i + unitHash(5, 3 * i)) / kWaves);
    const double heading = 0.6 + 2.6 * (unitHash(5, 3 * i + 1) - 0.5), k = 2.0 * 3.14159265358979 / length;
    kx_[i] = static_cast<float>(k * std::cos(heading)), ky_[i] = static_cast<float>(k * std::sin(heading));
    omega_[i] = static_cast<float>(std::sqrt(kGravity * k));
    phase_[i] = static_cast<float>(6.2831853 * unitHash(5, 3 * i + 2));
    length_[i] = static_cast<float>(length);
  }
}

WaterLook Ripples::look(const Eigen::Vector3f& place, const Eigen::Vector3f& normal,
                        const Eigen::Vector3f& direction, const Eigen::Vector3f& to_sun, double time,
                        float footprint) const {
  constexpr float kEach = kVariance / kWaves;
  // float holds the phase near the origin of the world and of time; far off the ripples just differ
  const Waves seen = (1.5f - 3.f * footprint / length_).max(0.f).min(1.f);
  const Waves slope = std::sqrt(2.f * kEach) * seen *
                      (kx_ * place.x() + ky_ * place.y() - omega_ * static_cast<float>(time) + phase_).sin();
  const Waves k = (kx_ * kx_ + ky_ * ky_).sqrt();
  const float variance = 0.0008f + kVariance - kEach * seen.square().sum();
  Eigen::Vector3f n = normal / std::max(0.2f, normal.z());
  n.x() -= (slope * kx_ / k).sum(), n.y() -= (slope * ky_ / k).sum();
  n.normalize();
  const Eigen::Vector3f view = -direction;
  // of a rough surface the slopes that face the eye are seen: the horizon is no mirror
  const float facing = std::max(0.f, n.dot(view)) + 0.7f * std::sqrt(variance);
  WaterLook out;
  out.mirrored = direction - 2.f * direction.dot(n) * n;
  out.mirrored.z() = std::abs(out.mirrored.z()) + 0.5f * std::sqrt(variance);
  out.mirrored.normalize();
  out.share = fresnel(facing);
  out.glitter = glitterOf(view, to_sun, n, variance);
  return out;
}

}  // namespace field_fusion::core::sim
