#pragma once
// What a picture truly shows.
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/outline.h"
#include "field_fusion/core/base/workers.h"

namespace field_fusion::core::sim {

/// One body with a label in a picture.
struct BodyView {
  int body = 0;          ///< place in World::bodies
  ImageBox box;          ///< of all of it inside the picture, also where it is hidden
  ImageBox visible_box;  ///< of what is seen of it; all 0 if nothing
  double visible = 0;    ///< 0..1, pixels that show it over pixels that would if it were alone
  std::uint8_t cut = 0;  ///< Cut bits: it reaches the outermost pixels there
};

/// Finds the labelled bodies of a world in pictures through a lens. Both must outlive it. Keeps its buffers
/// from picture to picture.
class ImageTruth {
 public:
  ImageTruth(const World& world, const Lens& lens);

  /// All that cover a pixel, hidden ones too, in the order of the world. `bodies` is Hit::body of each pixel
  /// (CV_32S). Pixels that do not show a body are cast at it alone, within the outline of its box. `time` is
  /// that of the picture, at which the caster's window must begin.
  std::vector<BodyView> views(const Caster& caster, const Transform& T_world_optical, double time,
                              const cv::Mat& bodies, Workers& workers);

  /// Pixels of a body.
  struct Count {
    int number = 0;
    cv::Point low{1 << 30, 1 << 30}, high{-1, -1};

    void add(int u, int v);
    void add(const Count& other);
    ImageBox box() const;
  };

 private:
  struct Shot {
    const Caster& caster;
    Eigen::Isometry3f T;  // T_world_optical
    const cv::Mat& bodies;
  };
  /// A row of the outline of a body.
  struct Stretch {
    int body, row, first, last;
    Count seen, alone;
  };
  /// Of one worker.
  struct Scratch {
    std::vector<Ray> rays;
    std::vector<int> columns;
    std::vector<float> ranges;
  };

  void findStretches(const Transform& T_world_optical, double time);
  void count(const Shot& shot, Stretch& stretch, Scratch& scratch) const;

  const World& world_;
  const Lens& lens_;
  std::vector<Outline> outlines_;
  std::vector<Stretch> stretches_;
  std::vector<Scratch> scratch_;
};

}  // namespace field_fusion::core::sim
