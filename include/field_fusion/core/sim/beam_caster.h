#pragma once
// Fires a grid of LiDAR beams, each at its own time and place and with a spot of its own size.
#include "field_fusion/core/sim/lidar_noise.h"
#include "field_fusion/core/sim/pose_track.h"
#include "field_fusion/core/base/workers.h"

namespace field_fusion::core::sim {

/// The beams of one turn of a scanner, row by row. A row is what one laser sees in the order of its shots;
/// the next row looks higher.
struct BeamGrid {
  int rows = 1, columns = 0;
  float step = 0.f;                         ///< [rad] between neighbours of a row
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors, sensor frame, as reported; rows x columns
  std::vector<float> times;                 ///< [s] after the start of the scan

  std::size_t size() const { return directions.size(); }
};

/// Keeps its buffers from scan to scan.
class BeamCaster {
 public:
  /// `seed` tells this sensor's constant errors and, with the time, each beam's noise.
  BeamCaster(const LidarParams& params, BeamGrid grid, std::uint64_t seed);

  /// Moves the caster's window to the scan. The result, in the grid's order, stays valid until the next call
  /// and does not depend on LidarParams::threads.
  const std::vector<BeamReturn>& run(Caster& caster, const PoseAt& T_world_sensor, double start);

  const std::vector<BeamReturn>& returns() const { return returns_; }  ///< of the last run
  const BeamGrid& grid() const { return grid_; }
  const LidarNoise& noise() const { return noise_; }
  double duration() const { return duration_; }  ///< [s] from the first beam to the last

 private:
  static constexpr int kRims = 8;  // rays beside the middle one: a packet of the caster

  struct Scan {
    const Caster& caster;
    const PoseTrack& track;
    std::uint64_t seed;
  };
  Ray middleRay(const Scan& scan, std::size_t beam) const;
  /// Of one worker: beams that wait for their rims.
  struct Waiting {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<std::size_t> beams;
  };
  void castMiddles(const Scan& scan, std::size_t first, std::size_t last);
  void castRims(const Scan& scan, std::size_t first, std::size_t last, Waiting& waiting);
  void flush(const Scan& scan, Waiting& waiting);
  void addRims(const Scan& scan, std::size_t beam, std::vector<Ray>& rays) const;
  bool atEdge(std::size_t beam) const;
  bool sameSurface(std::size_t beam, const Eigen::Vector3f& direction, const Hit& hit) const;
  BeamReturn measure(const Scan& scan, std::size_t beam, const Ray* rays, const Hit* hits) const;

  LidarParams params_;
  BeamGrid grid_;
  LidarNoise noise_;
  std::uint64_t seed_;
  double duration_;
  Workers workers_;
  std::vector<Waiting> waiting_;
  std::vector<Ray> middles_;
  std::vector<Hit> hits_;
  std::vector<BeamReturn> returns_;
};

}  // namespace field_fusion::core::sim
