#include "water_look.h"

#include <algorithm>

#include "random.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kPi = 3.14159265f;
/// Variance of the slope in a breeze of 3 m/s: 0.003 + 0.00512 U (Cox and Munk 1954).
constexpr float kVariance = 0.018f, kSmooth = 0.0008f;
constexpr float kFaintest = 16.f;  // e^-16 of the brightest glitter is none

/// Schlick 1994, for water of index 1.33.
FIELD_FUSION_INLINE float fresnel(float cosine) {
  const float c = 1.f - lesser(greater(cosine, 0.f), 1.f), c2 = c * c;
  return 0.02f + 0.98f * c2 * c2 * c;
}

}  // namespace

struct Ripples::Shape {
  Lanes<float> x, y, z;           // normal of the waves with the ripples
  Lanes<float> variance, spread;  // of the slope within the footprint, and its root
};

struct Ripples::Light {
  Lanes<float> mirrored[3], share;
  Lanes<float> glitter, exponent;  // glitter is the first times e^-the second
};

Ripples::Ripples(const Eigen::Vector3f& to_sun) : to_sun_{to_sun.x(), to_sun.y(), to_sun.z()} {
  constexpr double kGravity = 9.80665;
  for (int i = 0; i < kWaves; ++i) {
    const double length = 0.12 * std::pow(2.4 / 0.12, (i + unitHash(5, 3 * i)) / kWaves);
    const double heading = 0.6 + 2.6 * (unitHash(5, 3 * i + 1) - 0.5), k = 2.0 * 3.14159265358979 / length;
    Wave& w = waves_[i];
    w.kx = static_cast<float>(k * std::cos(heading)), w.ky = static_cast<float>(k * std::sin(heading));
    w.omega = static_cast<float>(std::sqrt(kGravity * k));
    w.phase = static_cast<float>(6.2831853 * unitHash(5, 3 * i + 2));
    w.ahead_x = static_cast<float>(std::cos(heading)), w.ahead_y = static_cast<float>(std::sin(heading));
    w.length = static_cast<float>(length);
  }
}

FIELD_FUSION_INLINE void Ripples::shape(const WaterPlaces& p, double time, Shape& s) const {
  constexpr float kEach = kVariance / kWaves;
  const float steep = std::sqrt(2.f * kEach);
  Lanes<float> across{}, along{}, seen_square{};
  for (const Wave& w : waves_) {
    // float holds the phase near the origin of the world and of time; far off the ripples just differ
    const float phase = w.phase - w.omega * static_cast<float>(time), coarse = 3.f / w.length;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float seen = lesser(greater(1.5f - coarse * p.footprint[i], 0.f), 1.f);
      const float slope = steep * seen * quickSine(w.kx * p.x[i] + w.ky * p.y[i] + phase);
      across[i] += slope * w.ahead_x, along[i] += slope * w.ahead_y, seen_square[i] += seen * seen;
    }
  }
  Lanes<float> up;
  for (std::size_t i = 0; i < kLanes; ++i) up[i] = greater(p.normal[2][i], 0.2f);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = p.normal[0][i] / up[i] - across[i], y = p.normal[1][i] / up[i] - along[i];
    const float z = p.normal[2][i] / up[i], whole = 1.f / std::sqrt(x * x + y * y + z * z);
    s.x[i] = whole * x, s.y[i] = whole * y, s.z[i] = whole * z;
    s.variance[i] = kSmooth + kVariance - kEach * seen_square[i];
    s.spread[i] = std::sqrt(s.variance[i]);
  }
}

/// Radiance of the sun on a rough surface (Cox and Munk 1954, Eq. 9) over that of a white sheet: the slope
/// that mirrors the sun occurs by a normal distribution about the mean one.
FIELD_FUSION_INLINE void Ripples::light(const WaterPlaces& p, const Shape& s, Light& l) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = p.sight[0][i], y = p.sight[1][i], z = p.sight[2][i];
    const float towards = -(x * s.x[i] + y * s.y[i] + z * s.z[i]);
    // of a rough surface the slopes that face the eye are seen: the horizon is no mirror
    l.share[i] = fresnel(greater(towards, 0.f) + 0.7f * s.spread[i]);
    const float mx = x + 2.f * towards * s.x[i], my = y + 2.f * towards * s.y[i];
    const float mz = std::abs(z + 2.f * towards * s.z[i]) + 0.5f * s.spread[i];
    const float whole = 1.f / std::sqrt(mx * mx + my * my + mz * mz);
    l.mirrored[0][i] = whole * mx, l.mirrored[1][i] = whole * my, l.mirrored[2][i] = whole * mz;
    const float bx = to_sun_[0] - x, by = to_sun_[1] - y, bz = to_sun_[2] - z;
    const float length = std::sqrt(bx * bx + by * by + bz * bz), half = bz / length;
    const float off_x = bx / bz - s.x[i] / s.z[i], off_y = by / bz - s.y[i] / s.z[i];
    const float square = half * half;
    l.exponent[i] = half < 0.2f ? kFaintest : (off_x * off_x + off_y * off_y) / s.variance[i];
    l.glitter[i] = fresnel(0.5f * length) / (4.f * s.variance[i] * greater(towards, 0.05f) * square * square);
  }
}

FIELD_FUSION_LANES void Ripples::lookAt(const WaterPlaces& places, double time, Light& l) const {
  Shape s;
  Light own;  // that nothing else could point to
  shape(places, time, s);
  light(places, s, own);
  l = own;
}

void Ripples::look(const WaterPlaces& places, double time, WaterLook* out, std::size_t count) const {
  Light l;
  lookAt(places, time, l);
  const bool day = to_sun_[2] > 0.f;
  for (std::size_t i = 0; i < count; ++i) {
    out[i].mirrored = {l.mirrored[0][i], l.mirrored[1][i], l.mirrored[2][i]};
    out[i].share = l.share[i];
    out[i].glitter = day && l.exponent[i] < kFaintest ? l.glitter[i] * std::exp(-l.exponent[i]) : 0.f;
  }
}

}  // namespace field_fusion::core::sim
