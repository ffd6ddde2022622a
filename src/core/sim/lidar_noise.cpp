#include "field_fusion/core/sim/lidar_noise.h"

#include <algorithm>

namespace field_fusion::core::sim {
namespace {

constexpr float kNearest = 0.05f;  // [m] where 1 / range^2 stops to grow: the receiver's optics end it

/// A return of surfaces further apart than this is called mixed.
constexpr float kMixed = 0.03f;  // [m]

/// The body that gave most of the light of `count` glints; of equals the nearest.
int mainBody(const Glint* glints, int count) {
  int main = Hit::kNothing;
  float most = 0.f;
  for (int i = 0; i < count; ++i) {
    float energy = 0.f;
    for (int k = 0; k < count; ++k) energy += glints[k].body == glints[i].body ? glints[k].energy : 0.f;
    if (energy > most) most = energy, main = glints[i].body;
  }
  return main;
}

}  // namespace

Eigen::Vector2f spotSize(const LidarParams& params, float range) {
  const Eigen::Vector2d at_exit(params.spot_width, params.spot_height);
  const Eigen::Vector2d growth(params.divergence_width, params.divergence_height);
  return (1e-3 * (at_exit + range * growth)).cast<float>();
}

float echoEnergy(const Hit& hit, const Eigen::Vector3f& direction) {
  if (!hit.material) return 0.f;
  const float range = std::max(hit.range, kNearest);
  const float diffuse = hit.material->reflectivity * (1.f - hit.material->gloss);
  return diffuse * std::abs(hit.normal.dot(direction)) / (range * range);
}

LidarNoise::LidarNoise(const LidarParams& params, int rows, std::uint64_t seed)
    : params_(params), biases_(static_cast<std::size_t>(rows)) {
  BeamRandom random(seed, 0);
  const auto between = [&](double limit) {
    return static_cast<float>(limit) * (2.f * random.uniform() - 1.f);
  };
  scale_ = between(params.range_scale);
  for (float& bias : biases_) bias = between(params.range_bias);
  threshold_ = static_cast<float>(0.1 / (params.ten_percent_range * params.ten_percent_range));
}

BeamReturn LidarNoise::measure(Glint* glints, int count, float slope, int row, BeamRandom& random) const {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  BeamReturn out{kInf, 0.f, glints[0].range, Hit::kNothing, false};
  if (params_.fault_rate > 0.0 && random.uniform() < params_.fault_rate) {
    out.range = kNaN;
    return out;
  }
  const auto nearer = [](const Glint& a, const Glint& b) { return a.range < b.range; };
  if (count > 1) std::sort(glints, glints + count, nearer);
  const float gain =
      params_.energy_noise > 0.0 ? 1.f + static_cast<float>(params_.energy_noise) * random.normal() : 1.f;
  const Pulse pulse = reported(glints, count, gain);
  if (!(pulse.energy > 0.f)) return out;
  const float range = erroneous(pulse.range, pulse.energy, slope, row, random);
  if (range > params_.max_range) return out;
  const bool too_near = range < params_.min_range;
  out.range = too_near ? -kInf : range;
  out.intensity = too_near ? 0.f : intensity(pulse.range, gain * pulse.energy);
  out.body = pulse.body;
  out.mixed = pulse.spread > kMixed;
  return out;
}

/// Glints that are less than a pulse apart from the next make one pulse at their energy's centre. Pulses
/// whose energy the receiver misses are left out.
LidarNoise::Pulse LidarNoise::reported(const Glint* glints, int count, float gain) const {
  Pulse best;
  for (int i = 0; i < count && std::isfinite(glints[i].range);) {
    Pulse pulse;
    const int first = i;
    float moment = 0.f;
    do {
      moment += glints[i].energy * (glints[i].range - glints[first].range);
      pulse.energy += glints[i].energy;
      ++i;
    } while (i < count && glints[i].range - glints[i - 1].range <= params_.pulse_length);
    if (!(gain * pulse.energy >= threshold_)) continue;
    pulse.range = glints[first].range + moment / pulse.energy;
    pulse.spread = glints[i - 1].range - glints[first].range;
    pulse.body = mainBody(glints + first, i - first);
    if (params_.echo != Echo::kStrongest || pulse.energy > best.energy) best = pulse;
    if (params_.echo == Echo::kFirst) break;
  }
  return best;
}

float LidarNoise::erroneous(float range, float energy, float slope, int row, BeamRandom& random) const {
  const float square = static_cast<float>(params_.range_noise_square) * range * range;
  const float weak2 =
      static_cast<float>(params_.range_noise_weak * params_.range_noise_weak) * threshold_ / energy;
  // a plane's ranges within an even spot of diameter d spread by sigma = d / 4 slope
  const float slant =
      static_cast<float>(params_.slant_noise) * 0.25f * spotSize(params_, range).mean() * slope;
  const float variance =
      static_cast<float>(params_.range_noise * params_.range_noise) + square * square + weak2 + slant * slant;
  const float noise = variance > 0.f ? std::sqrt(variance) * random.normal() : 0.f;
  const float out = range * (1.f + scale_) + biases_[row] + noise;
  if (!(params_.range_step > 0.0)) return out;
  return static_cast<float>(params_.range_step * std::round(out / params_.range_step));
}

float LidarNoise::intensity(float range, float energy) const {
  const float r = std::max(range, kNearest);
  const float value =
      params_.intensity == Intensity::kReflectivity ? energy * r * r : 10.f * std::log10(energy / threshold_);
  return std::round(std::clamp(static_cast<float>(params_.intensity_scale) * value, 0.f, 255.f));
}

}  // namespace field_fusion::core::sim
