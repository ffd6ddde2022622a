#pragma once
// How the points of a sensor_msgs/PointCloud2 lie in its bytes, for any driver's layout.
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion {

/// The fields of our own clouds, as core::Point lies in memory.
const std::vector<sensor_msgs::PointField>& pointFields();

/// Everything of a PointCloud2 but its bytes.
struct CloudShape {
  double stamp = 0.0;  ///< [s] header.stamp, to which absolute point times are made relative
  std::uint32_t height = 0, width = 0, point_step = 0, row_step = 0;
  std::vector<sensor_msgs::PointField> fields;
  bool is_bigendian = false;
};

/// Throws std::runtime_error where the field list that begins at `data` claims more fields than `size` bytes
/// can hold: reading it would first take memory for all of them.
void checkFieldCount(const std::uint8_t* data, std::uint64_t size);

/// Reads `size` bytes at `data` into points. `x y z` (float32 or float64) are required; `intensity`,
/// `ring` and a time are taken where present. Times: `time`, `t`, `timestamp`, `time_offset`, `offset_time`;
/// a float is seconds, an integer nanoseconds, and a float64 above 1e6 s an absolute time.
/// Throws std::runtime_error with text "what: details" when sizes or fields disagree.
core::Cloud readPoints(const CloudShape& shape, const std::uint8_t* data, std::uint64_t size);

}  // namespace field_fusion
