#include "film.h"

#include <algorithm>
#include <cmath>

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

Eigen::Vector3f at(const cv::Mat& light, float u, float v) {
  const float x = std::clamp(u, 0.f, static_cast<float>(light.cols - 1));
  const float y = std::clamp(v, 0.f, static_cast<float>(light.rows - 1));
  const int i = std::min(static_cast<int>(x), light.cols - 2),
            j = std::min(static_cast<int>(y), light.rows - 2);
  const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
  using Pixel = Eigen::Map<const Eigen::Vector3f>;
  const float *above = light.ptr<float>(j) + 3 * i, *below = light.ptr<float>(j + 1) + 3 * i;
  return (1 - t) * ((1 - s) * Pixel(above) + s * Pixel(above + 3)) +
         t * ((1 - s) * Pixel(below) + s * Pixel(below + 3));
}

}  // namespace

float scattered(const Eigen::Vector3f& d, const Eigen::Vector3f& to_sun) {
  constexpr float kSquareDegrees = 3282.8f;  // of one steradian
  const float square = std::max(1.f, kSquareDegrees * (d - to_sun).squaredNorm());
  return 10.f * 3.14159265f / square;
}

Eigen::Vector2f Motion::shift(const Lens& lens, const Eigen::Vector3f& ray, float range) const {
  const Eigen::Vector3d r = ray.cast<double>();
  const auto seen = [&](const Transform& T) {
    return lens.project(std::isfinite(range) ? Eigen::Vector3d(T * (static_cast<double>(range) * r))
                                             : Eigen::Vector3d(T.linear() * r));
  };
  return (seen(T_end_middle) - seen(T_begin_middle)).cast<float>();
}

float Motion::longest(const Lens& lens, float nearest) const {
  constexpr int kSteps = 8;
  float out = 0.f;
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const Eigen::Vector3f& ray =
          lens.ray(i * (lens.width() - 1) / kSteps, j * (lens.height() - 1) / kSteps);
      for (const float range : {nearest, std::numeric_limits<float>::infinity()})
        out = std::max(out, shift(lens, ray, range).norm());
    }
  return out;
}

void blurRow(const Lens& lens, const Motion& motion, const cv::Mat& light, const cv::Mat& ranges, int v,
             cv::Mat& out) {
  constexpr int kMost = 128;  // samples
  const float* range = ranges.ptr<float>(v);
  for (int u = 0; u < light.cols; ++u) {
    const Eigen::Vector2f shift = motion.shift(lens, lens.ray(u, v), range[u]);
    const float length = shift.norm();
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    const int n = length > kSharp ? std::min(kMost, 1 + static_cast<int>(length)) : 1;
    for (int i = 0; i < n; ++i) {
      const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(n) - 0.5f;
      sum += n == 1 ? at(light, u, v) : at(light, u + along * shift.x(), v + along * shift.y());
    }
    Eigen::Map<Eigen::Vector3f>(out.ptr<float>(v) + 3 * u) = sum / static_cast<float>(n);
  }
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

float Film::vignette(int u, int v) const {
  const auto x = static_cast<float>(u - params_.cx), y = static_cast<float>(v - params_.cy);
  return 1.f - static_cast<float>(params_.vignetting) * (x * x + y * y) / corner_;
}

double Film::meter(const cv::Mat& light, int v, double scale) const {
  const float* from = light.ptr<float>(v);
  const auto s = static_cast<float>(scale);
  double sum = 0.0;
  for (int u = 0; u < light.cols; ++u, from += 3) {
    const Eigen::Vector3f seen = (s * vignette(u, v) * Eigen::Map<const Eigen::Vector3f>(from)).cwiseMin(1.f);
    sum += static_cast<double>(luminance(seen));
  }
  return sum / light.cols;
}

void Film::develop(const cv::Mat& light, int v, const Exposure& exposure, std::uint64_t seed,
                   cv::Mat& out) const {
  const auto scale = static_cast<float>(exposure.scale());
  // electrons of a pixel: white is full_well / gain
  const float one = static_cast<float>(exposure.gain() / params_.full_well);
  const float read = static_cast<float>(params_.read_noise) * one;
  const float* from = light.ptr<float>(v);
  std::uint8_t* to = out.ptr(v);
  for (int u = 0; u < light.cols; ++u) {
    const float bright = scale * vignette(u, v);
    const std::uint64_t bits = params_.noise ? mixed(seed + static_cast<std::uint64_t>(u)) : 0;
    for (int c = 0; c < 3; ++c, ++from, ++to) {
      float x = std::min(bright * *from, 16.f);
      if (params_.noise) x += normal_[bits >> (12 * c) & (kSteps - 1)] * std::sqrt(x * one + read * read);
      *to = srgb_[static_cast<std::size_t>(std::clamp(x, 0.f, 1.f) * (kSteps - 1) + 0.5f)];
    }
  }
}

}  // namespace field_fusion::core::sim
