#pragma once
// A colour camera with a global shutter in a world.
#include <functional>
#include <memory>

#include "field_fusion/core/sim/image_truth.h"

namespace field_fusion::core::sim {

struct ColourFrame {
  double stamp = 0.0;          ///< [s] middle of the exposure
  double exposure_time = 0.0;  ///< [s]
  double gain = 0.0;           ///< [dB]
  cv::Mat image;               ///< CV_8UC3, red first
  cv::Mat bodies;              ///< CV_32S, Hit::body of each pixel's middle, without blur
  cv::Mat ranges;              ///< CV_32F [m] along each pixel's ray; infinite: sky
  std::vector<BodyView> views;
};

/// Sun with shadows, sky, textures, water, haze; then glare, motion blur, vignetting, exposure, noise and
/// quantisation. The camera's own motion blurs, that of the bodies does not. No rolling shutter, no Bayer
/// pattern. Keeps its buffers from picture to picture.
class ColourCamera {
 public:
  /// The world must outlive the camera and be the caster's. Throws std::invalid_argument for parameters that
  /// are out of range or fold the picture.
  ColourCamera(const CameraParams& params, const World& world, std::uint64_t seed);
  ~ColourCamera();

  /// Moves the caster's window to `stamp`. T_world_sensor is of the mount, x forward. The result stays valid
  /// until the next call and depends on all pictures before (by the exposure), not on CameraParams::threads.
  const ColourFrame& run(Caster& caster, const std::function<Transform(double time)>& T_world_sensor,
                         double stamp);

  const Lens& lens() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace field_fusion::core::sim
