#pragma once
#include <opencv2/core/mat.hpp>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/bearing.h"
#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/sim/scene.h"

namespace field_fusion::core {

/// A camera without distortion that looks along x.
struct SceneCamera {
  cv::Size size{1280, 720};
  Pinhole pinhole{800.0, 800.0, 639.5, 359.5};      // 77 deg wide
  Transform T_base_camera = Transform::Identity();  ///< of the optical frame; set by the constructor
  SceneCamera();
};

/// How one body shows in the image.
struct View {
  ImageBox box;        ///< [px] of the whole body, also where it is hidden or out of the image
  double visible = 0;  ///< 0..1, share of its area that nothing hides; 0 where it is not in the image
};

struct ScenePicture {
  cv::Mat image;            ///< bgr8
  std::vector<View> views;  ///< of each body of the scene
};

/// The scene at `time` [s]: flat-shaded bodies, the farthest first. A body that reaches behind the camera's
/// image plane is not drawn.
ScenePicture picture(const Scene& scene, double time, const SceneCamera& camera);

}  // namespace field_fusion::core
