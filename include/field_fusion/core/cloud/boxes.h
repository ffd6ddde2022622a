#pragma once
// Boxes as parameters write them: x_min, y_min, z_min, x_max, y_max, z_max each.
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Whether the numbers form boxes of six, each min below its max.
inline bool areBoxes(const std::vector<double>& numbers) {
  if (numbers.size() % 6 != 0) return false;
  for (std::size_t i = 0; i < numbers.size(); i += 6)
    for (std::size_t k = i; k < i + 3; ++k)
      if (!(numbers[k] < numbers[k + 3])) return false;
  return true;
}

inline std::vector<Eigen::AlignedBox3f> boxesOf(const std::vector<double>& numbers) {
  std::vector<Eigen::AlignedBox3f> out;
  for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6)
    out.emplace_back(Eigen::Vector3d(&numbers[i]).cast<float>(),
                     Eigen::Vector3d(&numbers[i + 3]).cast<float>());
  return out;
}

}  // namespace field_fusion::core
