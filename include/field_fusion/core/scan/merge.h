#pragma once
// Stage `scan_merge`: any number of scans as one, level and close above the ground (paper 004, Algorithm 1,
// PF).
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

struct MergeParams {
  double azimuth_min = -180.0;
  double azimuth_max = 180.0;
  double azimuth_step = 0.225;
  double range_min = 0.1;
  double range_max = 25.0;
  double min_height = 0.05;
  double max_height = 2.0;

  void declare(Params& p) {
    p.number("azimuth_min", azimuth_min, {-360.0, 360.0}, "deg", When::kLive,
             "Where the merged scan begins; it runs counter-clockwise to azimuth_max.");
    p.number("azimuth_max", azimuth_max, {-360.0, 360.0}, "deg", When::kLive, "Where it ends.");
    p.number("azimuth_step", azimuth_step, {0.01, 45.0}, "deg", When::kLive, "Between its beams.");
    p.number("range_min", range_min, {0.0, 100.0}, "m", When::kLive, "Nearer returns are dropped.");
    p.number("range_max", range_max, {0.1, 1000.0}, "m", When::kLive, "Farther returns are dropped.");
    p.number("min_height", min_height, {-10.0, 10.0}, "m", When::kLive,
             "Returns lower over the ground are floor that a tilted scanner met.");
    p.number("max_height", max_height, {-10.0, 100.0}, "m", When::kLive,
             "Returns higher over the ground are passed below.");
    p.rule([this] { return azimuth_min < azimuth_max && azimuth_max - azimuth_min <= 360.0; },
           "azimuth_max must lie above azimuth_min, by a turn at most");
    p.rule([this] { return azimuth_step <= azimuth_max - azimuth_min; },
           "azimuth_step must not exceed the sector");
    p.rule([this] { return range_min < range_max; }, "range_min must be below range_max");
    p.rule([this] { return min_height < max_height; }, "min_height must be below max_height");
  }
};

/// What became of the beams of the scans of one result.
struct MergeCounts {
  std::size_t returns = 0;  ///< with a range
  std::size_t floor = 0, above = 0, out_of_range = 0;
  std::size_t merged = 0;  ///< that took part
};

/// Projects returns down to the plane and keeps the nearest of each bin. A bin where no return lies is free
/// (+inf, as Algorithm 1 begins them) if a scanner that sees as far as `range_max` looked there and saw
/// nothing, too near (-inf) if all that one of them saw was that, and else NaN: nobody knows.
class ScanMerger {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit ScanMerger(const MergeParams& params = {}) { setParams(params); }
  void setParams(const MergeParams& params);

  /// Begins a result in a plane that lies `plane_height` [m] over the ground.
  void begin(double plane_height);
  /// Adds a scan without fault; T_plane_scanner at the instants of both.
  void add(const Scan& scan, const Transform& T_plane_scanner);
  /// Valid until the next `begin`.
  const Scan& result() const { return out_; }
  const MergeCounts& counts() const { return counts_; }

 private:
  void addReturn(const Eigen::Vector3d& at);
  void addLook(float reading, double from, double to);
  /// Of an azimuth; at or beyond the size where it lies in no bin.
  std::size_t binOf(double azimuth) const;

  MergeParams params_;
  Scan out_;
  bool round_ = true;
  double low_ = 0.0, high_ = 0.0;  // over the plane
  MergeCounts counts_;
};

}  // namespace field_fusion::core
