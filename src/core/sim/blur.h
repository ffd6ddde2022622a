#pragma once
// The picture as the motion of the camera smears it.
#include <opencv2/core/mat.hpp>

#include "field_fusion/core/sim/lens.h"

namespace field_fusion::core::sim {

/// Turns of the camera during an exposure, in the optical frame of its middle.
class Blur {
 public:
  Blur(const Lens& lens, const Transform& T_begin_middle, const Transform& T_end_middle);

  /// Whether any shift is seen, sampled over the picture for what is endlessly far and for the `nearest` [m].
  bool seen(float nearest) const;
  /// Row `v` of what is seen. `light` is CV_32FC3, `ranges` CV_32F [m].
  void row(const cv::Mat& light, const cv::Mat& ranges, int v, cv::Mat& out) const;

 private:
  struct Shifts;
  void shifts(const Eigen::Vector3f* rays, const float* ranges, std::size_t count, Shifts& out) const;

  const Lens& lens_;
  Eigen::Matrix<float, 3, 4> T_begin_middle_, T_end_middle_;
};

}  // namespace field_fusion::core::sim
