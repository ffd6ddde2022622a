#include "field_fusion/core/detect/mono_range.h"

#include <cmath>

namespace field_fusion::core {

MonoRange rangeFromHeight(const std::string& label, const ImageBox& box, std::uint8_t cut, double input_scale,
                          const Pinhole& camera, const RangeParams& params) {
  const auto height = params.class_heights.find(label);
  const double pixels = box.height();
  const bool usable =
      height != params.class_heights.end() && camera.known() && !(cut & (kCutTop | kCutBottom)) && pixels > 0;
  if (!usable) return {};
  const auto own_spread = params.class_height_spreads.find(label);
  const double spread =
      own_spread == params.class_height_spreads.end() ? params.height_spread : own_spread->second;
  const double height_error = std::sqrt(2.0) * params.box_pixel_error / input_scale;

  MonoRange result;
  result.depth = camera.fy * height->second / pixels;
  result.range = result.depth / bearing(box.centre(), camera).ray.z();
  result.sigma = result.range * std::hypot(height_error / pixels, spread);
  result.edge = result.range * params.box_pixel_error / input_scale / pixels;
  return std::isfinite(result.sigma) ? result : MonoRange{};
}

}  // namespace field_fusion::core
