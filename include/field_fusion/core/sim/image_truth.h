#pragma once
// What a picture truly shows.
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/outline.h"
#include "field_fusion/core/sim/workers.h"

namespace field_fusion::core::sim {

/// One body with a label in a picture.
struct BodyView {
  int body = 0;          ///< place in World::bodies
  ImageBox box;          ///< of all of it inside the picture, also where it is hidden
  ImageBox visible_box;  ///< of what is seen of it; all 0 if nothing
  double visible = 0;    ///< 0..1, pixels that show it over pixels that would if it were alone
  std::uint8_t cut = 0;  ///< Cut bits: it reaches the outermost pixels there
};

/// Finds the labelled bodies of a world in pictures through a lens. Both must outlive it.
class ImageTruth {
 public:
  ImageTruth(const World& world, const Lens& lens);

  /// All that cover a pixel, hidden ones too, in the order of the world. `bodies` is Hit::body of each pixel
  /// (CV_32S). Pixels that do not show a body are cast at it alone, within the outline of its box. `time` is
  /// that of the picture, at which the caster's window must begin.
  std::vector<BodyView> views(const Caster& caster, const Transform& T_world_optical, double time,
                              const cv::Mat& bodies, Workers& workers) const;

 private:
  const World& world_;
  const Lens& lens_;
  std::vector<Outline> outlines_;
};

}  // namespace field_fusion::core::sim
