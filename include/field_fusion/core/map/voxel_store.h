#pragma once
// Log-odds of voxels, in cubes of 8 x 8 x 8 that are found by their place.
#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "field_fusion/core/map/voxel_marks.h"

namespace field_fusion::core {

struct VoxelCube {
  std::array<float, kCubeVoxels> log_odds{};  ///< x + 8 y + 64 z within the cube; 0 where nothing is known
  CubeBits known{};
};

class VoxelStore {
 public:
  /// Made where there was none. Stays where it is until it is dropped.
  VoxelCube& cube(const CubeKey& place) {
    auto& slot = cubes_[place];
    if (!slot) slot = std::make_unique<VoxelCube>();
    return *slot;
  }
  const VoxelCube* find(const CubeKey& place) const {
    const auto found = cubes_.find(place);
    return found == cubes_.end() ? nullptr : found->second.get();
  }

  std::size_t size() const { return cubes_.size(); }  ///< [cubes]
  void clear() { cubes_.clear(); }

  /// Calls visit(place, cube) for all cubes, in no particular order.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (const auto& [place, cube] : cubes_) visit(place, *cube);
  }
  /// Drops the cubes of which outside(place) holds; how many.
  template <class Outside>
  std::size_t drop(const Outside& outside) {
    const std::size_t before = cubes_.size();
    for (auto cube = cubes_.begin(); cube != cubes_.end();)
      cube = outside(cube->first) ? cubes_.erase(cube) : ++cube;
    return before - cubes_.size();
  }

 private:
  struct Hash {
    std::size_t operator()(const CubeKey& k) const {
      // places are below 2^13 each: side by side they are one number, and the product spreads its low bits
      const std::uint64_t one = static_cast<std::uint32_t>(k.x() & 0x1fff) |
                                std::uint64_t(k.y() & 0x1fff) << 13 | std::uint64_t(k.z() & 0x1fff) << 26;
      return static_cast<std::size_t>(one * 0x9e3779b97f4a7c15ull >> 20);
    }
  };
  std::unordered_map<CubeKey, std::unique_ptr<VoxelCube>, Hash> cubes_;
};

/// Calls visit(i) for the bits that are set, from the lowest.
template <class Visit>
void forEachBit(const CubeBits& bits, const Visit& visit) {
  for (std::size_t w = 0; w < bits.size(); ++w)
    for (std::uint64_t left = bits[w]; left != 0; left &= left - 1)
      visit(static_cast<int>(64 * w) + __builtin_ctzll(left));
}

inline CubeKey cubeOf(const VoxelKey& voxel) {
  return {voxel.x() >> kCubeBits, voxel.y() >> kCubeBits, voxel.z() >> kCubeBits};
}

/// As counted in CubeBits.
inline int indexInCube(const VoxelKey& voxel) {
  const auto in = [](int place) { return place & (kCubeSide - 1); };
  return in(voxel.x()) + kCubeSide * (in(voxel.y()) + kCubeSide * in(voxel.z()));
}

/// Voxel i of a cube, as counted in CubeBits.
inline VoxelKey voxelOf(const CubeKey& cube, int i) {
  return cube * kCubeSide + VoxelKey(i & 7, i >> 3 & 7, i >> 6);
}

}  // namespace field_fusion::core
