#pragma once
// Stage `costmap`: obstacle points as the ranges of a made-up planar laser scanner.
#include <vector>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

struct ObstacleScanParams {
  double azimuth_min = -180.0;
  double azimuth_max = 180.0;
  double azimuth_step = 0.25;
  double range_min = 0.0;
  double range_max = 30.0;
  double point_radius = 0.05;

  void declare(Params& p) {
    p.number("azimuth_min", azimuth_min, {-360.0, 360.0}, "deg", When::kLive,
             "Where the scan begins; it runs counter-clockwise to azimuth_max. Only what the LiDAR looks at: "
             "a ray without obstacle is free.");
    p.number("azimuth_max", azimuth_max, {-360.0, 360.0}, "deg", When::kLive,
             "Where the scan ends. A sector across 180 is written 150 to 210 or 150 to -150.");
    p.number(
        "azimuth_step", azimuth_step, {0.01, 45.0}, "deg", When::kLive,
        "Rays of the scan are no farther apart. Not below the LiDAR's own: rays would pass between points.");
    p.number("range_min", range_min, {0.0, 1000.0}, "m", When::kLive,
             "Shortest range of the scan; an obstacle that is nearer is put there, not lost.");
    p.number("range_max", range_max, {0.1, 10000.0}, "m", When::kLive,
             "What is as far or farther is left out; rays without obstacle are free up to here.");
    p.number("point_radius", point_radius, {0.001, 10.0}, "m", When::kLive,
             "How far a point reaches to its sides: half the distance between points of one body.");
    p.rule([this] { return azimuth_min != azimuth_max; }, "azimuth_min and azimuth_max must differ");
    p.rule([this] { return range_min < range_max; }, "range_min must be below range_max");
  }
};

/// Ray i points to azimuth `azimuth` + i * `step`.
struct ObstacleScan {
  double azimuth = 0.0, step = 0.0;  ///< [rad]
  std::vector<float> ranges;         ///< [m] in the x-y plane; +inf: free (REP-117); NaN: not looked at
};

/// Takes for each ray the nearest of the points whose disc of `point_radius` touches the ray's share of the
/// circle, half a step to either side. So a body narrower than a step marks a ray, wherever it stands, and
/// the nearest return of a share is never lost. Keeps its buffer from run to run.
class ObstacleScanner {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit ObstacleScanner(const ObstacleScanParams& params = {}) { setParams(params); }
  void setParams(const ObstacleScanParams& params);

  /// `looked`: rays without obstacle are free; otherwise they are not known (NaN). So are those that meet one
  /// of the points `unclear`, of which it is not known whether they are an obstacle. The result stays valid
  /// until the next call.
  const ObstacleScan& run(const Cloud& points, bool looked, const Cloud& unclear = {});

 private:
  void mark(const Point& point);

  ObstacleScanParams params_;
  ObstacleScan scan_;
};

}  // namespace field_fusion::core
