#pragma once
// Union-find: which of n things hang together.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace field_fusion::core {

/// Things 0 ... n - 1 in disjoint sets; a set is named by its lowest member. Keeps its buffer.
class DisjointSets {
 public:
  /// n sets of one.
  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The lowest member of the set that holds `i`.
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t root_a = root(a), root_b = root(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace field_fusion::core
