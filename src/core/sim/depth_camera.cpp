#include "field_fusion/core/sim/depth_camera.h"

#include <algorithm>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

constexpr std::uint64_t kGrainNoise = 1ull << 40;  // sequence of the matcher's noise

/// 0..1 of a texture, of which `pixels` cover one pattern: finer than two pixels it is grey.
float contrast(const Material& material, float pixels) {
  if (material.texture == Material::Texture::kPlain) return 0.f;
  return (material.colour - material.colour2).cwiseAbs().mean() * std::min(1.f, 0.5f * pixels);
}

}  // namespace

DepthCamera::DepthCamera(const DepthCameraParams& params, std::uint64_t seed)
    : params_(checked(params)), seed_(seed), workers_(params.threads) {
  scale_ = params.depth_scale * (2.0 * BeamRandom(seed, 0).uniform() - 1.0);
  image_.width = params.width, image_.height = params.height;
  image_.focal_length = params.focal_length;
  image_.centre_x = 0.5 * (params.width - 1), image_.centre_y = 0.5 * (params.height - 1);
  const std::size_t pixels = static_cast<std::size_t>(params.width) * params.height;
  image_.metres.resize(pixels), image_.millimetres.resize(pixels);
  truth_.metres.resize(pixels), truth_.bodies.resize(pixels);
  match_.resize(pixels);
  const std::size_t grains = static_cast<std::size_t>(params.width / params.noise_grain + 2) *
                             (params.height / params.noise_grain + 2);
  disparity_grains_.resize(grains), match_grains_.resize(grains);
}

const DepthImage& DepthCamera::frame(Caster& caster, const PoseAt& T_world_sensor, double stamp) {
  const PoseTrack::Pose pose = PoseTrack(T_world_sensor, stamp, stamp).at(0.f);
  caster.setWindow(stamp, stamp);
  image_.stamp = stamp;
  const std::uint64_t seed = seedOf(seed_, stamp);
  drawGrains(seed);
  const std::size_t rows = static_cast<std::size_t>(params_.height);
  workers_.share(rows, [&](std::size_t row, int) { castRow(caster, pose, static_cast<int>(row)); });
  workers_.share(rows, [&](std::size_t row, int) { matchRow(static_cast<int>(row), seed); });
  return image_;
}

/// The projector's dots are as bright as the surface is light, and fade with the square of range; texture of
/// its own a surface keeps at any range.
void DepthCamera::castRow(const Caster& caster, const PoseTrack::Pose& pose, int row) {
  constexpr int kBatch = 64;
  Ray rays[kBatch];
  Hit hits[kBatch];
  const float focal = static_cast<float>(params_.focal_length),
              reach = static_cast<float>(params_.projector_range);
  const float up = (static_cast<float>(image_.centre_y) - static_cast<float>(row)) / focal;
  for (int begin = 0; begin < params_.width; begin += kBatch) {
    const int count = std::min(kBatch, params_.width - begin);
    for (int i = 0; i < count; ++i) {
      const float left = (static_cast<float>(image_.centre_x) - static_cast<float>(begin + i)) / focal;
      rays[i] = {pose.position, pose.rotation * Eigen::Vector3f(1.f, left, up).normalized(), 0.f};
    }
    caster.cast(rays, hits, static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const std::size_t pixel = static_cast<std::size_t>(row) * params_.width + begin + i;
      const Hit& hit = hits[i];
      const float left = (static_cast<float>(image_.centre_x) - static_cast<float>(begin + i)) / focal;
      truth_.metres[pixel] = hit.material ? hit.range / std::sqrt(1.f + left * left + up * up) : kNaN;
      truth_.bodies[pixel] = hit.body;
      if (!hit.material) continue;
      const Material& material = *hit.material;
      const float light =
          material.reflectivity * (1.f - material.gloss) * std::abs(hit.normal.dot(rays[i].direction));
      match_[pixel] = light * reach * reach / (hit.range * hit.range) +
                      static_cast<float>(params_.texture_weight) * (1.f - material.gloss) *
                          contrast(material, material.texture_size * focal / hit.range);
    }
  }
}

/// Seen from the right imager, what lies at column u and disparity d lies at u - d. Pixels to the right of u
/// that come to lie there or further left are nearer and hide it.
void DepthCamera::matchRow(int row, std::uint64_t seed) {
  const float unit = static_cast<float>(params_.focal_length * params_.baseline);
  float leftmost = std::numeric_limits<float>::infinity();
  for (int column = params_.width - 1; column >= 0; --column) {
    const std::size_t pixel = static_cast<std::size_t>(row) * params_.width + column;
    const float depth = truth_.metres[pixel];
    float out = kNaN;
    if (std::isfinite(depth)) {
      const float in_right = static_cast<float>(column) - unit / depth;
      const bool hidden = in_right < -0.5f || in_right >= leftmost;
      leftmost = std::min(leftmost, in_right);
      if (!hidden) out = measured(depth, row, column, seed);
    }
    image_.metres[pixel] = out;
    image_.millimetres[pixel] =
        std::isnan(out) || out > 65.535f ? 0 : static_cast<std::uint16_t>(std::lround(1e3f * out));
  }
}

/// A neighbour's disparity is another by more than a pixel: the window holds two surfaces.
bool DepthCamera::atStep(int row, int column) const {
  const float unit = static_cast<float>(params_.focal_length * params_.baseline);
  const std::size_t pixel = static_cast<std::size_t>(row) * params_.width + column;
  const auto differs = [&](std::size_t other) {
    const float mine = unit / truth_.metres[pixel], its = unit / truth_.metres[other];
    return !(std::abs(mine - its) < 1.f);
  };
  return (column > 0 && differs(pixel - 1)) || (column + 1 < params_.width && differs(pixel + 1)) ||
         (row > 0 && differs(pixel - params_.width)) ||
         (row + 1 < params_.height && differs(pixel + params_.width));
}

void DepthCamera::drawGrains(std::uint64_t seed) {
  for (std::size_t i = 0; i < match_grains_.size(); ++i) {
    BeamRandom random(seed + kGrainNoise, i);
    disparity_grains_[i] = random.normal(), match_grains_[i] = random.normal();
  }
}

/// Sigma 1 everywhere: the grains themselves, and between them their weighted mean.
float DepthCamera::grainNoise(const std::vector<float>& grains, int row, int column) const {
  const int grain = params_.noise_grain, stride = params_.width / grain + 2;
  const float down = static_cast<float>(row % grain) / static_cast<float>(grain);
  const float right = static_cast<float>(column % grain) / static_cast<float>(grain);
  const float* corner = &grains[static_cast<std::size_t>(row / grain * stride + column / grain)];
  const Eigen::Vector4f values(corner[0], corner[1], corner[stride], corner[stride + 1]);
  const Eigen::Vector4f weights((1.f - down) * (1.f - right), (1.f - down) * right, down * (1.f - right),
                                down * right);
  return weights.dot(values) / weights.norm();
}

float DepthCamera::measured(float depth, int row, int column, std::uint64_t seed) const {
  const std::size_t pixel = static_cast<std::size_t>(row) * params_.width + column;
  const float luck = params_.match_noise > 0.0 ? grainNoise(match_grains_, row, column) : 0.f;
  if (match_[pixel] * (1.f + static_cast<float>(params_.match_noise) * luck) < 1.f) return kNaN;
  if (params_.edge_loss > 0.0 && atStep(row, column) && BeamRandom(seed, pixel).uniform() < params_.edge_loss)
    return kNaN;
  const double unit = params_.focal_length * params_.baseline;
  double disparity = unit / (depth * (1.0 + scale_));
  if (params_.disparity_noise > 0.0)
    disparity += params_.disparity_noise * grainNoise(disparity_grains_, row, column);
  if (params_.disparity_step > 0.0)
    disparity = params_.disparity_step * std::round(disparity / params_.disparity_step);
  if (!(disparity > 0.0)) return kNaN;
  double out = unit / disparity;
  if (params_.depth_step > 0.0) out = params_.depth_step * std::round(out / params_.depth_step);
  return out >= params_.min_range && out <= params_.max_range ? static_cast<float>(out) : kNaN;
}

}  // namespace field_fusion::core::sim
