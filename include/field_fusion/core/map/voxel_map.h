#pragma once
// Stage `voxel_map`: occupancy of voxels from clouds of points, and its projection on the plane (paper 004,
// section 4.2: map B).
#include <cmath>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/base/workers.h"
#include "field_fusion/core/map/occupancy.h"
#include "field_fusion/core/map/voxel_store.h"

namespace field_fusion::core {

struct VoxelMapParams {
  double resolution = 0.05;
  double max_range = 5.0;
  double hit = 0.7;
  double miss = 0.4;
  double clamp_min = 0.12;
  double clamp_max = 0.97;
  double occupied = 0.5;
  double min_height = 0.05;
  double max_height = 0.6;
  double window = 20.0;
  int threads = 0;

  void declare(Params& p) {
    p.number("resolution", resolution, {0.005, 5.0}, "m", When::kStart,
             "Side of a voxel, and of a cell of map B.");
    p.number("max_range", max_range, {0.05, 1000.0}, "m", When::kLive,
             "Of a farther point only the way up to here counts, as free.");
    p.number("hit", hit, {0.5, 1.0}, "", When::kLive,
             "Probability that a voxel in which a ray ends is occupied.");
    p.number("miss", miss, {0.0, 0.5}, "", When::kLive,
             "Probability that a voxel through which a ray goes is occupied.");
    p.number("clamp_min", clamp_min, {0.0, 0.5}, "", When::kLive,
             "A voxel's probability never falls below, so that what comes is seen soon.");
    p.number("clamp_max", clamp_max, {0.5, 1.0}, "", When::kLive,
             "Nor does it rise above, so that what goes is forgotten soon.");
    p.number("occupied", occupied, {0.01, 0.99}, "", When::kLive,
             "Probability from which a voxel is occupied.");
    p.number("min_height", min_height, {-1000.0, 1000.0}, "m", When::kLive,
             "In map_frame: voxels whose middle is lower are floor to map B.");
    p.number("max_height", max_height, {-1000.0, 1000.0}, "m", When::kLive,
             "Voxels whose middle is higher are passed below.");
    p.number("window", window, {0.0, 10000.0}, "m", When::kLive,
             "Voxels farther than half of it from the robot, along x or y, are forgotten; 0: none are.");
    p.number("threads", threads, {0, 64}, "", When::kStart, "That follow the rays; 0: as many as cores.");
    p.rule([this] { return min_height < max_height; }, "min_height must be below max_height");
    p.rule([this] { return hit < 1.0 && miss > 0.0 && clamp_min > 0.0 && clamp_max < 1.0; },
           "hit and clamp_max must be below 1, miss and clamp_min above 0");
    p.rule([this] { return reach() <= VoxelMarks::kMostReach; },
           "max_range must not be above 998 times the resolution");
  }

  int reach() const { return static_cast<int>(std::ceil(max_range / resolution)) + 1; }  ///< [voxels]
};

struct VoxelCounts {
  std::size_t points = 0;              ///< taken in
  std::size_t far = 0;                 ///< of them, beyond max_range
  std::size_t unusable = 0;            ///< not finite, or beyond the lattice
  std::size_t occupied = 0, free = 0;  ///< voxels that they changed or confirmed
};

/// The sensor model and clamping of OctoMap (Hornung et al. 2013): of one cloud each voxel gets one update,
/// and ends of rays win over ways. Gives the very log-odds that octomap::OcTree::insertPointCloud gives, in
/// whatever number of threads.
class VoxelMap {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit VoxelMap(const VoxelMapParams& params = {});
  /// All but those of the start take effect; throws likewise.
  void setLive(const VoxelMapParams& params);

  /// Points [m] as the sensor sees them.
  VoxelCounts insert(const Cloud& cloud, const Transform& T_map_sensor);
  /// Points [m] in the map, seen from `sensor`.
  VoxelCounts insert(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& sensor);

  /// NaN where nothing is known.
  float logOdds(const VoxelKey& voxel) const;
  bool isOccupied(float log_odds) const { return log_odds >= occupied_; }

  /// Map B: of each column between the heights, the highest probability that is known, in percent. Of the
  /// whole map, or of a square of `side` [m] about a place. Cells are those of the lattice.
  Occupancy project() const;
  Occupancy projectAbout(double x, double y, double side) const;
  /// Forgets what is farther than the window allows from a place [m]; how many cubes.
  std::size_t keepAbout(double x, double y);
  void clear() { store_.clear(); }

  const VoxelLattice& lattice() const { return lattice_; }
  const VoxelMapParams& params() const { return params_; }
  const VoxelStore& store() const { return store_; }
  /// To fill a map from elsewhere.
  void set(const VoxelKey& voxel, float log_odds);

 private:
  void mark(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& sensor, std::size_t part,
            VoxelMarks& marks, VoxelCounts& counts) const;
  void update(VoxelCounts& counts);
  Occupancy project(const CellArea& area) const;

  VoxelMapParams params_;
  VoxelLattice lattice_;
  Workers workers_;
  VoxelStore store_;
  std::vector<VoxelMarks> marks_;  // of each worker
  std::vector<VoxelCounts> counted_;
  std::vector<Eigen::Vector3f> points_;
  float hit_ = 0.f, miss_ = 0.f, min_ = 0.f, max_ = 0.f, occupied_ = 0.f;  // log-odds
};

}  // namespace field_fusion::core
