#pragma once
// Rao-Blackwellised particle filter for maps of the plane (Grisetti, Stachniss, Burgard: Improved Techniques for
// Grid Mapping with Rao-Blackwellized Particle Filters, 2007).
#include <cstdint>
#include <optional>
#include <vector>

#include "field_fusion/core/base/workers.h"
#include "field_fusion/core/map/grid_slam_params.h"
#include "field_fusion/core/map/scan_insertion.h"
#include "field_fusion/core/map/scan_matcher.h"
#include "field_fusion/core/map/slam_path.h"

namespace field_fusion::core {

/// The result depends on parameters, seed and input alone, not on the number of threads.
class GridSlam {
 public:
  enum class Outcome {
    kSkipped,    ///< too little motion since the last one that was taken in
    kProcessed,  ///< matched, weighed, and in the maps
    kBlind,      ///< no beam of the scan says anything: odometry alone
  };
  struct Particle {
    Pose2 pose;  ///< T_map_base
    double log_weight = 0.0;  ///< since the last resampling
    double log_total = 0.0;   ///< since the start, for the best path
    double fit = 1.0;         ///< share of the last scan's beams that end where its map has a wall, or has not looked yet
    TileMap map;
    PathNode::Pointer path;
  };

  /// Throws std::invalid_argument with every fault of the parameters.
  explicit GridSlam(const GridSlamParams& params = {});

  /// `T_odom_base` at the scan's stamp. The map's frame is odometry's until the first correction.
  /// Throws std::invalid_argument for a pose that is not finite.
  Outcome process(const SlamScan& scan, const Pose2& T_odom_base, std::int64_t stamp_ns);
  /// Forgets everything. With `map`, goes on in that map from `start.mean`, which the first scan corrects.
  void reset();
  void reset(const TileMap& map, const PosePrior& start);
  /// Takes over what may change while it runs: When::kLive.
  void setLive(const GridSlamParams& params);

  const std::vector<Particle>& particles() const { return particles_; }
  const std::vector<double>& weights() const { return weights_; }  ///< sum to 1
  const Particle& best() const { return particles_[best_]; }
  /// T_map_base at the last scan, also of one that was skipped.
  Pose2 pose() const { return best().pose * since_.step; }
  double effective() const { return effective_; }
  /// 0..1, of the last scan that was not blind: low where the robot is not where the best particle takes it to be.
  double fit() const { return best().fit; }
  std::uint64_t odometryJumps() const { return jumps_; }
  const GridSlamParams& params() const { return params_; }

 private:
  bool due(std::int64_t stamp_ns) const;
  void follow(const Pose2& T_odom_base, std::int64_t stamp_ns);
  void begin(const Pose2& T_odom_base, std::int64_t stamp_ns);
  PosePrior prior(const Particle& particle) const;
  void move(Particle& particle, std::size_t index, const SlamScan& scan, ScanMatcher& matcher) const;
  void weigh();
  void resample();
  void record(const SlamScan& scan, std::int64_t stamp_ns);

  GridSlamParams params_;
  Workers workers_;
  std::vector<ScanMatcher> matchers_;     // of each worker
  std::vector<ScanInsertion> insertions_;  // likewise
  std::vector<Particle> particles_;
  std::vector<double> weights_;
  std::optional<PosePrior> start_;  // in a map that was there before, until the first scan
  std::size_t best_ = 0;
  double effective_ = 0.0;
  Motion since_;      // the last scan that was taken in
  Pose2 last_odom_;
  std::int64_t odom_ns_ = 0, last_ns_ = 0;  // of the last scan, and of the last that was taken in
  std::uint64_t count_ = 0, jumps_ = 0;  // scans taken in
};

}  // namespace field_fusion::core
