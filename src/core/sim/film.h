#pragma once
// From the light at the pixels to numbers: what lens and sensor do to a picture, one row at a time.
#include <array>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/sim/exposure.h"
#include "field_fusion/core/sim/lens.h"

namespace field_fusion::core::sim {

/// Light that the lens scatters about the sun: 10 E / theta^2 (theta in degrees, Stiles and Holladay 1929)
/// for a human eye, as radiance over that of a white sheet (E = pi of it), in any direction `d`.
float scattered(const Eigen::Vector3f& d, const Eigen::Vector3f& to_sun);

/// Sensor of 12 bits behind a vignetting lens; output in sRGB.
class Film {
 public:
  explicit Film(const CameraParams& params);

  /// Mean brightness 0..1 of a row, pixels that overflow taken as white.
  double meter(const cv::Mat& light, int v, double scale) const;
  /// `seed` of the row.
  void develop(const cv::Mat& light, int v, const Exposure& exposure, std::uint64_t seed, cv::Mat& out) const;

 private:
  static constexpr int kSteps = 4096;

  static constexpr int kBlock = 64;
  struct Block {
    float value[3 * kBlock] = {};
  };

  void expose(const float* light, int u, int v, std::size_t count, float scale, Block& out) const;
  void disturb(std::uint64_t seed, std::size_t count, float one, float read, Block& block) const;

  CameraParams params_;
  float corner_;                           // [px^2] from the middle
  std::array<std::uint8_t, kSteps> srgb_;  // of the sensor's numbers
  std::array<float, kSteps> normal_;       // quantiles of the normal distribution, variance 1
};

}  // namespace field_fusion::core::sim
