#include "texture.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core::sim {
namespace {

std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16, x *= 0x7feb352du;
  x ^= x >> 15, x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Trilinear between random numbers 0..1 on the lattice.
float lattice(const Eigen::Vector3f& place) {
  const Eigen::Array3f below = place.array().floor();
  const Eigen::Array3f s = place.array() - below;
  const Eigen::Array3f w = s * s * (3.f - 2.f * s);
  const Eigen::Array3i cell = below.max(-1e9f).min(1e9f).cast<int>();
  float corners[8];
  for (int i = 0; i < 8; ++i) {
    const auto x = static_cast<std::uint32_t>(cell.x() + (i & 1)),
               y = static_cast<std::uint32_t>(cell.y() + (i >> 1 & 1)),
               z = static_cast<std::uint32_t>(cell.z() + (i >> 2));
    corners[i] =
        static_cast<float>(hashed(x * 0x9e3779b1u + y * 0x85ebca77u + z * 0xc2b2ae3du) >> 8) * 0x1p-24f;
  }
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const float low = mix(mix(corners[0], corners[1], w.x()), mix(corners[2], corners[3], w.x()), w.y());
  const float high = mix(mix(corners[4], corners[5], w.x()), mix(corners[6], corners[7], w.x()), w.y());
  return mix(low, high, w.z());
}

/// Patterns begin a fraction of their size beside the origin, so that the faces of a body, which often lie
/// at whole multiples, do not lie on their borders.
constexpr float kOffset = 0.3137f;

float stripes(float along) {
  return std::floor(along + kOffset) - 2.f * std::floor(0.5f * (along + kOffset));
}

float checker(const Eigen::Vector3f& p) {
  return stripes(p.x()) + stripes(p.y()) + stripes(p.z()) == 1.f ||
         stripes(p.x()) + stripes(p.y()) + stripes(p.z()) == 3.f;
}

/// Bricks of 1 x 1/3 with the other colour as mortar, on all upright faces.
float bricks(const Eigen::Vector3f& p) {
  constexpr float kMortar = 0.05f;
  const float layer = 3.f * p.z() + kOffset, row = std::floor(layer);
  const float along = p.x() + p.y() + kOffset + 0.5f * stripes(row);
  return layer - row < 3.f * kMortar || along - std::floor(along) < kMortar;
}

/// Discs where a face cuts balls on a lattice, and half as many half-way.
bool dots(const Eigen::Vector3f& p) {
  const Eigen::Array3f off = p.array() + kOffset - (p.array() + kOffset).round();
  return off.square().sum() < 0.16f;
}

bool grid(const Eigen::Vector3f& p) {
  const Eigen::Array3f at = p.array() + kOffset;
  return (at - at.floor()).minCoeff() < 0.1f;
}

float planks(const Eigen::Vector3f& p) {
  const float across = std::clamp(p.x() + p.y() + kOffset, -1e9f, 1e9f);
  return static_cast<float>(hashed(static_cast<std::uint32_t>(static_cast<int>(std::floor(across)))) >> 8) *
         0x1p-24f;
}

bool wedges(const Eigen::Vector3f& p) {
  constexpr float kWedge = 0.78539816f;  // [rad]
  return stripes(std::atan2(p.y(), p.x()) / kWedge) == 1.f;
}

/// 0..1, share of the other colour; its mean over the pattern in `mean`.
float share(const Material& material, const Eigen::Vector3f& p, float footprint, float& mean) {
  using Texture = Material::Texture;
  mean = 0.5f;
  switch (material.texture) {
    case Texture::kNoise:
      return std::clamp(2.f * smoothNoise(p, 3, footprint) - 0.5f, 0.f, 1.f);
    case Texture::kChecker:
      return checker(p);
    case Texture::kStripes:
      return stripes(p.z());
    case Texture::kBricks:
      mean = 0.19f;  // 1 - (1 - 0.05) (1 - 0.15)
      return bricks(p);
    case Texture::kBlotches:
      return smoothNoise(p, 3, footprint) > 0.5f;
    case Texture::kDots:
      mean = 0.268f;  // 4/3 pi 0.4^3
      return dots(p);
    case Texture::kGrid:
      mean = 0.19f;  // on a face: 1 - 0.9^2
      return grid(p);
    case Texture::kSlants:
      return stripes(0.577f * p.sum());
    case Texture::kPlanks:
      return planks(p);
    case Texture::kWedges:
      return wedges(p);
    case Texture::kPlain:
      break;
  }
  return mean = 0.f;
}

/// Factor of the dirt.
float worn(float wear, const Eigen::Vector3f& place, float footprint) {
  if (wear == 0.f) return 1.f;
  constexpr float kScale = 2.3f;  // [1/m]
  const float dirt = smoothNoise(kScale * place, 4, kScale * footprint);
  return 1.f - wear * std::clamp(2.5f * (dirt - 0.35f), 0.f, 1.f);
}

Eigen::Vector3f patternAt(const Material& material, const Eigen::Vector3f& place, float footprint) {
  if (material.texture == Material::Texture::kPlain || !(material.texture_size > 0.f)) return material.colour;
  const float seen = footprint / material.texture_size;
  float mean = 0.f;
  float other = share(material, place / material.texture_size, seen, mean);
  other += std::clamp(3.f * seen - 0.5f, 0.f, 1.f) * (mean - other);
  return material.colour + other * (material.colour2 - material.colour);
}

}  // namespace

float smoothNoise(const Eigen::Vector3f& place, int octaves, float footprint) {
  float sum = 0.5f, weight = 0.5f, scale = 1.f;
  for (int i = 0; i < octaves && footprint * scale < 1.f; ++i, scale *= 2.07f, weight *= 0.5f)
    sum += weight * std::min(1.f, 2.f - 2.f * footprint * scale) * 2.f * (lattice(scale * place) - 0.5f);
  return sum;
}

Eigen::Vector3f colourAt(const Material& material, const Eigen::Vector3f& place, float footprint) {
  return worn(material.wear, place, footprint) * patternAt(material, place, footprint);
}

float groundMottle(const Eigen::Vector3f& place, float footprint) {
  const float coarse = smoothNoise(0.2f * place, 2, 0.2f * footprint);
  const float fine = smoothNoise(9.f * place, 2, 9.f * footprint);
  return 1.f + 0.5f * (coarse - 0.5f) + 0.35f * (fine - 0.5f);
}

}  // namespace field_fusion::core::sim
