#pragma once
// Where a body may be seen in a picture.
#include <opencv2/core/types.hpp>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/lens.h"

namespace field_fusion::core::sim {

/// Boxes of a model's links, to bound its outline at any time without its vertices.
class Outline {
 public:
  explicit Outline(const Model& model);

  /// Pixels that bound the body's projection, by the edges of its box at that time; empty: out of sight.
  cv::Rect rect(const Model& model, const Transform& T_optical_body, double time, const Lens& lens) const;

 private:
  std::vector<Eigen::AlignedBox3d> links_;
};

}  // namespace field_fusion::core::sim
