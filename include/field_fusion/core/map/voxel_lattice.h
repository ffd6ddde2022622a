#pragma once
// The lattice of OctoMap's voxels (Hornung et al. 2013): which voxel a place lies in, and which ones a ray
// goes through.
#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace field_fusion::core {

/// Place of a voxel [voxels] from the one that begins at the origin. Each is within +-kMostVoxels.
using VoxelKey = Eigen::Vector3i;

/// octomap::OcTreeKey counts from here, so that maps end where OctoMap's do.
constexpr int kMostVoxels = 32768;

class VoxelLattice {
 public:
  explicit VoxelLattice(double resolution = 0.05) : resolution_(resolution), per_metre_(1.0 / resolution) {}

  double resolution() const { return resolution_; }  ///< [m]
  /// None beyond the lattice, and of a place that is not finite.
  std::optional<VoxelKey> key(const Eigen::Vector3f& place) const;
  Eigen::Vector3d centre(const VoxelKey& key) const {
    return (key.cast<double>().array() + 0.5) * resolution_;
  }

 private:
  double resolution_, per_metre_;
};

/// The way of a ray from voxel to voxel (Amanatides and Woo 1987), rounded at each step as
/// octomap::computeRayKeys rounds: the same voxels are passed, even where a ray goes through their edges. The
/// voxel of the end is not among them.
struct VoxelRay {
  VoxelKey begin, end;      ///< voxels; where they are one, nothing is passed
  int step[3] = {0, 0, 0};  ///< -1, 0 or 1
  double next[3] = {},
         span[3] = {};  ///< [m] along the ray: to the next voxel of each axis, and from one to the next
  float length = 0.f;   ///< [m]

  /// None where an end lies beyond the lattice.
  static std::optional<VoxelRay> between(const VoxelLattice& lattice, const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& end);

  /// pass() for the voxel of the origin; then for each way into a voxel step(axis), and pass() if it is
  /// passed. at_end(): whether the voxel last stepped to is `end`.
  template <class Step, class AtEnd, class Pass>
  void walk(const Step& step_to, const AtEnd& at_end, const Pass& pass) const {
    if (begin == end) return;
    pass();
    double x = next[0], y = next[1], z = next[2];
    const double length_m = length;
    while (true) {
      if (x < y && x < z)
        step_to(0), x += span[0];
      else if (!(x < y) && y < z)
        step_to(1), y += span[1];
      else
        step_to(2), z += span[2];
      if (at_end()) return;
      const double nearest = x < y ? (x < z ? x : z) : (y < z ? y : z);
      if (nearest > length_m) return;  // rounding led past the end
      pass();
    }
  }
};

}  // namespace field_fusion::core
