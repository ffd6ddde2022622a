#include "field_fusion/core/detect/bearing.h"

namespace field_fusion::core {

Bearing bearing(cv::Point2d pixel, const Pinhole& camera) {
  // Asked first, because Eigen leaves a vector that holds NaN as it is instead of normalising it.
  if (!camera.known() || !std::isfinite(pixel.x + pixel.y))
    return {Eigen::Vector3d::Constant(kNaN), kNaN, kNaN};
  const Eigen::Vector3d ray =
      Eigen::Vector3d((pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy, 1.0).normalized();
  // The same ray with x forward, y left, z up, where azimuth and elevation are defined.
  const Polar direction = polar({ray.z(), -ray.x(), -ray.y()});
  return {ray, direction.azimuth, direction.elevation};
}

}  // namespace field_fusion::core
