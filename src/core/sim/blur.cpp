#include "blur.h"

#include <algorithm>
#include <limits>

#include "field_fusion/core/sim/lanes.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kSharp = 1.f;  // [px] a shift that needs no second sample
constexpr float kEndless = std::numeric_limits<float>::infinity();

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

/// Of points at x, y, z [m], or in that direction where `at` is 0: the pixel once the camera has moved. NaN
/// where they are not in front.
FIELD_FUSION_INLINE void see(const PlumbBob<float>& lens, const Eigen::Matrix<float, 3, 4>& T, float x,
                             float y, float z, float at, float& u, float& v) {
  const float right = T(0, 0) * x + T(0, 1) * y + T(0, 2) * z + at * T(0, 3);
  const float down = T(1, 0) * x + T(1, 1) * y + T(1, 2) * z + at * T(1, 3);
  const float ahead = T(2, 0) * x + T(2, 1) * y + T(2, 2) * z + at * T(2, 3);
  const float front = ahead > 0.f ? ahead : std::numeric_limits<float>::quiet_NaN();
  lens.pixel(right / front, down / front, u, v);
}

}  // namespace

/// [px] that eight pixels move; NaN if they are not in front at both ends.
struct Blur::Shifts {
  Lanes<float> right, down, square;
};

Blur::Blur(const Lens& lens, const Transform& T_begin_middle, const Transform& T_end_middle)
    : lens_(lens),
      T_begin_middle_(T_begin_middle.matrix().topRows<3>().cast<float>()),
      T_end_middle_(T_end_middle.matrix().topRows<3>().cast<float>()) {}

FIELD_FUSION_LANES void Blur::shifts(const Eigen::Vector3f* rays, const float* ranges, std::size_t count,
                                     Shifts& out) const {
  Lanes<float> x, y, z, at, right, down;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::size_t j = std::min(i, count - 1);
    const bool finite = std::isfinite(ranges[j]);
    const float range = finite ? ranges[j] : 1.f;
    x[i] = range * rays[j].x(), y[i] = range * rays[j].y(), z[i] = range * rays[j].z();
    at[i] = finite ? 1.f : 0.f;
  }
  const PlumbBob<float> lens = lens_.formula<float>();
  const Eigen::Matrix<float, 3, 4> T0 = T_begin_middle_, T1 = T_end_middle_;
  for (std::size_t i = 0; i < kLanes; ++i) {
    float u0, v0, u1, v1;
    see(lens, T0, x[i], y[i], z[i], at[i], u0, v0);
    see(lens, T1, x[i], y[i], z[i], at[i], u1, v1);
    right[i] = u1 - u0, down[i] = v1 - v0;
  }
  for (std::size_t i = 0; i < kLanes; ++i) out.square[i] = right[i] * right[i] + down[i] * down[i];
  out.right = right, out.down = down;
}

bool Blur::seen(float nearest) const {
  constexpr int kSteps = 8;
  constexpr float kSurely = 0.8f * kSharp;  // it may be longer between the samples
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const Eigen::Vector3f& ray =
          lens_.ray(i * (lens_.width() - 1) / kSteps, j * (lens_.height() - 1) / kSteps);
      const float ranges[] = {nearest, kEndless};
      const Eigen::Vector3f rays[] = {ray, ray};
      Shifts s;
      shifts(rays, ranges, 2, s);
      if (s.square[0] > kSurely * kSurely || s.square[1] > kSurely * kSurely) return true;
    }
  return false;
}

void Blur::row(const cv::Mat& light, const cv::Mat& ranges, int v, cv::Mat& out) const {
  constexpr int kMost = 128;  // samples
  const float* range = ranges.ptr<float>(v);
  float* to = out.ptr<float>(v);
  std::copy_n(light.ptr<float>(v), 3 * light.cols, to);
  const auto columns = static_cast<std::size_t>(light.cols);
  for (std::size_t first = 0; first < columns; first += kLanes) {
    const std::size_t count = std::min(kLanes, columns - first);
    Shifts s;
    shifts(&lens_.ray(static_cast<int>(first), v), range + first, count, s);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(s.square[i] > kSharp * kSharp)) continue;
      const int n = std::min(kMost, 1 + static_cast<int>(std::sqrt(s.square[i])));
      const auto u = static_cast<float>(first + i);
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int k = 0; k < n; ++k) {
        const float along = (static_cast<float>(k) + 0.5f) / static_cast<float>(n) - 0.5f;
        sum += at(light, u + along * s.right[i], static_cast<float>(v) + along * s.down[i]);
      }
      Eigen::Map<Eigen::Vector3f>(to + 3 * (first + i)) = sum / static_cast<float>(n);
    }
  }
}

}  // namespace field_fusion::core::sim
