#include "film.h"

#include <algorithm>
#include <cmath>

#include "field_fusion/core/sim/lanes.h"
#include "random.h"
#include "texture.h"

namespace field_fusion::core::sim {
namespace {

/// IEC 61966-2-1.
double srgbOf(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double normalQuantile(double p) {
  double low = -9.0, high = 9.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return low;
}

}  // namespace

float scattered(const Eigen::Vector3f& d, const Eigen::Vector3f& to_sun) {
  constexpr float kSquareDegrees = 3282.8f;  // of one steradian
  const float square = std::max(1.f, kSquareDegrees * (d - to_sun).squaredNorm());
  return 10.f * 3.14159265f / square;
}

Film::Film(const CameraParams& params) : params_(params) {
  const double x = std::max(params.cx, params.width - 1 - params.cx);
  const double y = std::max(params.cy, params.height - 1 - params.cy);
  corner_ = static_cast<float>(x * x + y * y);
  double square = 0.0;
  std::array<double, kSteps> quantiles;
  for (int i = 0; i < kSteps; ++i) {
    srgb_[i] = static_cast<std::uint8_t>(std::lround(255.0 * srgbOf(i / (kSteps - 1.0))));
    quantiles[i] = normalQuantile((i + 0.5) / kSteps);
    square += quantiles[i] * quantiles[i] / kSteps;
  }
  for (int i = 0; i < kSteps; ++i) normal_[i] = static_cast<float>(quantiles[i] / std::sqrt(square));
}

/// What the sensor gets of pixels from column `u` on, as a share of white.
FIELD_FUSION_LANES void Film::expose(const float* light, int u, int v, std::size_t count, float scale,
                                     Block& out) const {
  const auto cx = static_cast<float>(params_.cx), y = static_cast<float>(v - params_.cy);
  const float lost = static_cast<float>(params_.vignetting) / corner_, y2 = y * y;
  float bright[3 * kBlock];
  for (std::size_t i = 0; i < count; ++i) {
    const float x = static_cast<float>(u + static_cast<int>(i)) - cx;
    bright[3 * i] = bright[3 * i + 1] = bright[3 * i + 2] = scale * (1.f - lost * (x * x + y2));
  }
  for (std::size_t k = 0; k < 3 * count; ++k) out.value[k] = bright[k] * light[k];
}

/// Adds shot and read noise: electrons of a pixel times `one` are its value, `read` is sigma in the dark.
FIELD_FUSION_LANES void Film::disturb(std::uint64_t seed, std::size_t count, float one, float read,
                                      Block& block) const {
  float sigma[3 * kBlock];
  for (std::size_t k = 0; k < 3 * count; ++k) sigma[k] = std::sqrt(block.value[k] * one + read * read);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = mixed(seed + i);
    for (std::size_t c = 0; c < 3; ++c)
      block.value[3 * i + c] += normal_[bits >> (12 * c) & (kSteps - 1)] * sigma[3 * i + c];
  }
}

double Film::meter(const cv::Mat& light, int v, double scale) const {
  const float* from = light.ptr<float>(v);
  double sum = 0.0;
  Block block;
  for (int u = 0; u < light.cols; u += kBlock) {
    const auto count = static_cast<std::size_t>(std::min(kBlock, light.cols - u));
    expose(from + 3 * u, u, v, count, static_cast<float>(scale), block);
    for (float& x : block.value) x = lesser(x, 1.f);
    for (std::size_t i = 0; i < count; ++i)
      sum += static_cast<double>(luminance(Eigen::Map<const Eigen::Vector3f>(block.value + 3 * i)));
  }
  return sum / light.cols;
}

void Film::develop(const cv::Mat& light, int v, const Exposure& exposure, std::uint64_t seed,
                   cv::Mat& out) const {
  constexpr float kBrightest = 16.f;
  // electrons of a pixel: white is full_well / gain
  const float one = static_cast<float>(exposure.gain() / params_.full_well);
  const float read = static_cast<float>(params_.read_noise) * one;
  const float* from = light.ptr<float>(v);
  std::uint8_t* to = out.ptr(v);
  Block block;
  for (int u = 0; u < light.cols; u += kBlock) {
    const auto count = static_cast<std::size_t>(std::min(kBlock, light.cols - u));
    expose(from + 3 * u, u, v, count, static_cast<float>(exposure.scale()), block);
    for (float& x : block.value) x = lesser(x, kBrightest);
    if (params_.noise) disturb(seed + static_cast<std::uint64_t>(u), count, one, read, block);
    for (std::size_t k = 0; k < 3 * count; ++k) {
      const float x = lesser(greater(block.value[k], 0.f), 1.f);
      to[3 * u + static_cast<int>(k)] = srgb_[static_cast<std::size_t>(x * (kSteps - 1) + 0.5f)];
    }
  }
}

}  // namespace field_fusion::core::sim
