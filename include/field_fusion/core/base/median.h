#pragma once
#include <algorithm>
#include <utility>
#include <vector>

namespace field_fusion::core {

/// The middle of at least one value; of an even number the upper of the two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Standard deviation of a normal distribution about 0 whose values have this median of their sizes; 0 of none.
inline double sigmaByMedian(std::vector<double> sizes) {
  constexpr double kMedianOfNormal = 0.6745;
  return sizes.empty() ? 0.0 : median(std::move(sizes)) / kMedianOfNormal;
}

}  // namespace field_fusion::core
