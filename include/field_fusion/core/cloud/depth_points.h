#pragma once
// A depth image as a cloud in the camera's optical frame (x right, y down, z ahead).
#include <cmath>
#include <type_traits>

#include "field_fusion/core/cloud/depth_scan.h"

namespace field_fusion::core {

/// [m]; 0 or less: no depth.
template <class Pixel>
float depthMetres(Pixel pixel) {
  if constexpr (std::is_integral_v<Pixel>) return 0.001f * static_cast<float>(pixel);
  return std::isfinite(pixel) ? static_cast<float>(pixel) : 0.f;
}

/// Every `step`-th pixel of every `step`-th row that has a depth; row by row. `out` keeps its memory.
template <class Pixel>
void depthPoints(const DepthImage<Pixel>& image, int step, Cloud& out) {
  out.clear();
  for (int v = 0; v < image.height; v += step) {
    const Pixel* row = image.pixels + static_cast<std::size_t>(v) * image.row;
    const float y = static_cast<float>((v - image.cy) / image.fy);
    for (int u = 0; u < image.width; u += step) {
      const float depth = depthMetres(row[u]);
      if (!(depth > 0.f)) continue;
      Point& point = out.emplace_back();
      point.x = depth * static_cast<float>((u - image.cx) / image.fx), point.y = depth * y, point.z = depth;
    }
  }
}

}  // namespace field_fusion::core
