#pragma once
// The slow obvious DBSCAN that core::Dbscan must equal: every pair of points is looked at.
#include <limits>
#include <utility>
#include <vector>

#include "field_fusion/core/cloud/dbscan.h"

namespace field_fusion::test {

/// The same labels, renumbered in the order in which they first appear: equal for equal partitions.
inline std::vector<int> inOrderOfAppearance(std::vector<int> labels) {
  std::vector<int> number;
  int next = 0;
  for (int& label : labels) {
    if (label == core::kNoise) continue;
    if (static_cast<std::size_t>(label) >= number.size()) number.resize(label + 1, core::kNoise);
    if (number[label] == core::kNoise) number[label] = next++;
    label = number[label];
  }
  return labels;
}

inline float distance2(const core::Point& a, const core::Point& b) {
  return core::squaredDistance(a.x, a.y, a.z, b.x, b.y, b.z);
}

/// Labels by the rules stated at core::Dbscan, in order of appearance; `neighbours` tells for two points
/// whether they are.
template <class Neighbours>
std::vector<int> bruteDbscan(const core::Cloud& cloud, int min_points, Neighbours&& neighbours) {
  const auto near = [&](std::size_t i, std::size_t j) { return neighbours(cloud[i], cloud[j]); };
  const std::size_t n = cloud.size();

  std::vector<bool> core(n);
  for (std::size_t i = 0; i < n; ++i) {
    int count = 0;
    for (std::size_t j = 0; j < n && core::usable(cloud[i]); ++j)
      count += core::usable(cloud[j]) && near(i, j);
    core[i] = count >= min_points;
  }

  std::vector<int> labels(n, core::kNoise);
  int clusters = 0;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (!core[seed] || labels[seed] != core::kNoise) continue;
    std::vector<std::size_t> open{seed};
    labels[seed] = clusters;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      for (std::size_t j = 0; j < n; ++j)
        if (core[j] && labels[j] == core::kNoise && near(i, j)) labels[j] = clusters, open.push_back(j);
    }
    ++clusters;
  }

  for (std::size_t i = 0; i < n; ++i) {
    if (core[i] || !core::usable(cloud[i])) continue;
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < n; ++j)
      if (core[j] && near(i, j) && distance2(cloud[i], cloud[j]) < nearest)
        nearest = distance2(cloud[i], cloud[j]), labels[i] = labels[j];
  }
  return inOrderOfAppearance(std::move(labels));
}

inline std::vector<int> bruteDbscan(const core::Cloud& cloud, float epsilon, int min_points) {
  return bruteDbscan(cloud, min_points, [&](const core::Point& a, const core::Point& b) {
    return distance2(a, b) <= epsilon * epsilon;
  });
}

}  // namespace field_fusion::test
