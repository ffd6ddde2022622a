#include "field_fusion/core/map/voxel_marks.h"

#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

constexpr int kInner = 3 * kCubeBits;  // bits of a place within its cube
constexpr int kMargin = 2;             // [voxels] that rounding may lead a ray past its end

}  // namespace

void VoxelMarks::begin(const VoxelKey& sensor, int reach) {
  if (reach < 0 || reach > kMostReach)
    throw std::invalid_argument("a window of " + std::to_string(reach) + " voxels");
  for (const std::uint32_t place : touched_) slots_[place] = 0;
  touched_.clear(), cubes_.clear();
  // so many cubes that the window holds all rays wherever in its cube the sensor stands
  int bits = 1;
  while ((1 << bits) * kCubeSide < 2 * (reach + kMargin) + 1 + kCubeSide) ++bits;
  if (bits != bits_) {
    bits_ = bits;
    slots_.assign(std::size_t{1} << (3 * bits), 0);
    const std::uint32_t inner = kCubeSide - 1, outer = (1u << bits) - 1;
    for (int i = 0; i < 3; ++i) {
      mask_[i] = inner << (kCubeBits * i) | outer << (kInner + bits * i);
      one_[i] = 1u << (kCubeBits * i);
    }
  }
  for (int i = 0; i < 3; ++i) low_[i] = (sensor[i] - reach - kMargin) & ~(kCubeSide - 1);
}

std::uint32_t VoxelMarks::placeOf(const VoxelKey& voxel) const {
  std::uint32_t place = 0;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::uint32_t>(voxel[i] - low_[i]);
    place |= (at & (kCubeSide - 1)) << (kCubeBits * i) | (at >> kCubeBits) << (kInner + bits_ * i);
  }
  return place;
}

VoxelMarks::Cube& VoxelMarks::cubeAt(std::uint32_t place) {
  std::uint32_t& slot = slots_[place >> kInner];
  if (slot == 0) {
    cubes_.emplace_back();
    touched_.push_back(place >> kInner);
    slot = static_cast<std::uint32_t>(cubes_.size());
  }
  return cubes_[slot - 1];
}

void VoxelMarks::pass(const VoxelRay& ray) {
  std::uint32_t place = placeOf(ray.begin);
  const std::uint32_t end = placeOf(ray.end);
  // what is added to an axis' bits for its step: 1, or all of them, which is -1
  std::uint32_t add[3];
  for (int i = 0; i < 3; ++i) add[i] = ray.step[i] > 0 ? one_[i] : mask_[i];
  const auto step = [&](int axis) {
    const std::uint32_t mask = mask_[axis];
    place = (((place | ~mask) + add[axis]) & mask) | (place & ~mask);
  };
  const auto pass = [&] {
    cubeAt(place).passed[place >> 6 & (kCubeSide - 1)] |= std::uint64_t{1} << (place & 63);
  };
  ray.walk(
      step, [&] { return place == end; }, pass);
}

void VoxelMarks::hit(const VoxelKey& voxel) {
  const std::uint32_t place = placeOf(voxel);
  cubeAt(place).hit[place >> 6 & (kCubeSide - 1)] |= std::uint64_t{1} << (place & 63);
}

void VoxelMarks::add(const VoxelMarks& other) {
  for (std::size_t i = 0; i < other.cubes_.size(); ++i) {
    Cube& cube = cubeAt(other.touched_[i] << kInner);
    for (std::size_t w = 0; w < cube.hit.size(); ++w) {
      cube.passed[w] |= other.cubes_[i].passed[w];
      cube.hit[w] |= other.cubes_[i].hit[w];
    }
  }
}

CubeKey VoxelMarks::cube(std::size_t i) const {
  const auto at = [&](int axis) {
    return static_cast<int>(touched_[i] >> (bits_ * axis) & ((1u << bits_) - 1)) + (low_[axis] >> kCubeBits);
  };
  return {at(0), at(1), at(2)};
}

CubeBits VoxelMarks::free(std::size_t i) const {
  CubeBits out = cubes_[i].passed;
  for (std::size_t w = 0; w < out.size(); ++w) out[w] &= ~cubes_[i].hit[w];
  return out;
}

}  // namespace field_fusion::core
