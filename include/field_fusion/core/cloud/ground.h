#pragma once
// Parts the ground from what stands on it: one plane, found by RANSAC (paper 001, section V-A), or the uneven
// ground that follows this plane.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/ground_surface.h"
#include "field_fusion/core/cloud/plane.h"

namespace field_fusion::core {

enum class GroundMethod { kSurface, kPlane };

struct GroundParams {
  GroundMethod method = GroundMethod::kSurface;
  double distance = 0.2;
  double max_slope = 6.0;
  double max_step = 0.15;
  double max_tilt = 15.0;
  double sensor_height = 0.0;
  double height_tolerance = 0.5;
  double max_height_change = 0.3;
  double memory = 1.0;
  int min_inliers = 100;
  double min_confidence = 0.5;
  int tries = 3000;
  bool drop_below = false;
  double bright = 0.0;
  int seed = 1;

  void declare(Params& p) {
    p.choice(
        "method", method, {"surface", "plane"}, When::kLive,
        "What the ground is. surface: uneven, near the plane, metre by metre. plane: the plane (paper 001).");
    p.number("distance", distance, {0.01, 2.0}, "m", When::kLive, "Points so near to the ground are ground.");
    p.number("max_slope", max_slope, {0.0, 30.0}, "deg", When::kLive,
             "surface: steepest ground, against the plane.");
    p.number("max_step", max_step, {0.01, 1.0}, "m", When::kLive,
             "surface: highest step of the ground, such as a kerb; what is lower is no body.");
    p.number("max_tilt", max_tilt, {0.1, 60.0}, "deg", When::kLive,
             "Largest angle between the plane's normal and up.");
    p.number("sensor_height", sensor_height, {0.0, 1000.0}, "m", When::kLive,
             "Expected height of the sensor above the ground; 0 where it is not known.");
    p.number("height_tolerance", height_tolerance, {0.01, 100.0}, "m", When::kLive,
             "Largest departure from sensor_height.");
    p.number("max_height_change", max_height_change, {0.01, 1000.0}, "m", When::kLive,
             "Largest change of the sensor's height since the last plane found.");
    p.number("memory", memory, {0.0, 60.0}, "s", When::kLive,
             "Age at which the last plane found is forgotten.");
    p.number("min_inliers", min_inliers, {3, 1000000}, "points", When::kLive,
             "Fewest ground points that make a plane.");
    p.number("min_confidence", min_confidence, {0.0, 1.0}, "", When::kLive,
             "Least confidence that makes a plane.");
    p.number("tries", tries, {10, 100000}, "", When::kLive, "Most triples of points that are tried.");
    p.flag("drop_below", drop_below, When::kLive,
           "Drop points below the ground (mirror images in wet roads); else they stay as obstacles.");
    p.number("bright", bright, {0.0, 1e5}, "", When::kLive,
             "A point near the ground of at least this intensity, and more than twice as bright as the ground "
             "would be if hit squarely, is a body, such as a float on water; 0: none is.");
    p.number("seed", seed, {0, 1000000}, "", When::kLive,
             "Of the random choice; the same input gives the same plane.");
  }
};

/// Why no plane was found: what is wrong with the best one that can be had.
enum class GroundFault {
  kNone,
  kTooFewPoints,
  kDegenerate,
  kTilt,
  kHeight,
  kHeightChange,
  kTooFewInliers,
  kLowConfidence
};

/// One sentence for the log and the diagnostics; empty for kNone.
const char* describe(GroundFault fault);

struct Ground {
  GroundFault fault = GroundFault::kNone;
  Plane plane;               ///< in the cloud's frame, normal up; NaN when not found
  double tilt = kNaN;        ///< [rad] between the normal and up
  double thickness = kNaN;   ///< [m] standard deviation of the ground points along the normal
  std::size_t inliers = 0;   ///< points within `distance` of the plane
  std::size_t below = 0;     ///< points farther below it
  std::size_t unusable = 0;  ///< points that are not finite or too far away
  /// 0 ... 1, the product of two shares. Of the points not above the plane, those on it: nothing solid lies
  /// below the ground, so many points there mean that the plane is a table or a roof. And 1 - thickness /
  /// width of the ground points: a narrow strip of ground does not fix the tilt.
  double confidence = 0.0;

  bool found() const { return fault == GroundFault::kNone; }
};

/// Finds the ground plane of each cloud; remembers the last height for max_height_change. Keeps its buffers.
///
/// Water sends nearly nothing back, so that what floats on it, however low, is told by its brightness where
/// `bright` is set. The ground's own is the median of intensity over the sine of the grazing angle.
class GroundFinder {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit GroundFinder(const GroundParams& params = {}) { setParams(params); }
  void setParams(const GroundParams& params);
  /// Forgets the last plane.
  void reset() { last_stamp_ = kNaN; }

  /// Parts `cloud` (neither of the outputs) into points on the ground and the rest, each in its order;
  /// without a plane all usable points are obstacles. Points below the ground are obstacles too, or in
  /// neither output with `drop_below`; unusable points are in neither. `stamp` [s]; `up` is a unit vector in
  /// the cloud's frame, else std::invalid_argument.
  Ground run(const Cloud& cloud, double stamp, Cloud& ground, Cloud& obstacles,
             const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

 private:
  Ground find(const Cloud& cloud, const Eigen::Vector3d& up);
  void refine(const Cloud& cloud, const Eigen::Vector3d& up, Ground& result) const;
  void count(const Cloud& cloud, Ground& result) const;
  void measure(const Cloud& cloud, const Ground& result);
  void split(const Cloud& cloud, double brightest, Cloud& ground, Cloud& obstacles) const;
  GroundFault judge(Plane& plane, const Eigen::Vector3d& up) const;
  GroundFault faultOfBest(const Eigen::Vector3d& up);

  GroundParams params_;
  double brightest(const Cloud& cloud, const Ground& result);

  PlaneSearch search_;
  GroundSurface surface_;
  std::vector<std::uint32_t> usable_;
  std::vector<float> shades_;
  std::vector<double> heights_;  // [m] above the ground of each usable point; NaN without a plane
  double last_stamp_ = kNaN, last_height_ = kNaN;
};

}  // namespace field_fusion::core
