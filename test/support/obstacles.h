#pragma once
// Obstacle messages for tests.
#include <string>

#include "field_fusion/Obstacle.h"
#include "field_fusion/core/base/types.h"

namespace field_fusion::test {

/// A body of 1 m x 1 m x 1 m at range [m] and azimuth [deg], at the height of the LiDAR.
inline Obstacle obstacleAt(std::uint8_t source, double range, double azimuth_degrees,
                           const std::string& label = "") {
  Obstacle out;
  out.source = source;
  const auto p = core::cartesian({range, core::radians(azimuth_degrees), 0.0});
  out.position.x = p.x(), out.position.y = p.y(), out.position.z = p.z();
  const bool lidar = source != Obstacle::SOURCE_CAMERA;
  out.size.x = out.size.y = out.size.z = lidar ? 1.0 : double(core::kNaN);
  out.range = static_cast<float>(range);
  out.azimuth = static_cast<float>(core::radians(azimuth_degrees));
  out.label = label;
  out.label_probability = label.empty() ? core::kNaN : 0.5f;
  out.range_difference = out.azimuth_difference = source == Obstacle::SOURCE_BOTH ? 0.f : core::kNaN;
  return out;
}

}  // namespace field_fusion::test
