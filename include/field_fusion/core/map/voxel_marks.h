#pragma once
// Which voxels the rays of one cloud pass and end in, each but once: bits in cubes of 8 x 8 x 8.
#include <array>
#include <cstdint>
#include <vector>

#include "field_fusion/core/map/voxel_lattice.h"

namespace field_fusion::core {

constexpr int kCubeBits = 3, kCubeSide = 1 << kCubeBits;  ///< [voxels]
constexpr int kCubeVoxels = kCubeSide * kCubeSide * kCubeSide;
/// A bit a voxel: x + 8 y + 64 z within the cube. A line of the cache.
using CubeBits = std::array<std::uint64_t, kCubeVoxels / 64>;
/// [cubes] from the one at the origin.
using CubeKey = Eigen::Vector3i;

/// The window of a cloud about its sensor. Keeps its memory from cloud to cloud; what it clears is what was
/// touched.
class VoxelMarks {
 public:
  static constexpr int kMostReach = 1000;  ///< [voxels]: a table of 64 MiB

  /// `reach` [voxels] from the sensor's voxel to the farthest that a ray meets; at most kMostReach.
  void begin(const VoxelKey& sensor, int reach);
  void pass(const VoxelRay& ray);
  void hit(const VoxelKey& voxel);
  /// Adds what another marked in the same window.
  void add(const VoxelMarks& other);

  std::size_t size() const { return cubes_.size(); }
  CubeKey cube(std::size_t i) const;
  const CubeBits& hits(std::size_t i) const { return cubes_[i].hit; }
  /// Passed, and no end of a ray.
  CubeBits free(std::size_t i) const;

 private:
  struct Cube {
    CubeBits passed{}, hit{};
  };
  // A place in the window is one number: for each axis 3 bits within the cube (below), and bits_ of the
  // cube's place (above those of all three). A step along an axis adds to its bits alone, the others being
  // filled so that a carry goes through.
  std::uint32_t placeOf(const VoxelKey& voxel) const;
  Cube& cubeAt(std::uint32_t place);

  VoxelKey low_ = VoxelKey::Zero();  // first voxel of the window
  int bits_ = 0;                     // of a cube's place along an axis
  std::array<std::uint32_t, 3> mask_{}, one_{};
  std::vector<std::uint32_t> slots_;    // by the cube's place: 1 + its index in cubes_, 0 none
  std::vector<std::uint32_t> touched_;  // places of the cubes
  std::vector<Cube> cubes_;
};

}  // namespace field_fusion::core
