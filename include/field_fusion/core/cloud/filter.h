#pragma once
// Keeps the points of a cloud that matter: sector, range, region of interest, the robot's own body, density.
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/boxes.h"
#include "field_fusion/core/cloud/voxel.h"

namespace field_fusion::core {

struct FilterParams {
  double azimuth_min = -180.0;
  double azimuth_max = 180.0;
  double min_range = 0.0;
  double max_range = 1000.0;
  std::vector<double> box;
  std::vector<double> body;
  double voxel_size = 0.0;

  void declare(Params& p) {
    p.number(
        "azimuth_min", azimuth_min, {-360.0, 360.0}, "deg", When::kLive,
        "Where the kept sector begins, in the sensor's frame; it runs counter-clockwise to azimuth_max.");
    p.number("azimuth_max", azimuth_max, {-360.0, 360.0}, "deg", When::kLive,
             "Where the kept sector ends. A sector across 180 is written 150 to 210 or 150 to -150.");
    p.number("min_range", min_range, {0.0, 1000.0}, "m", When::kLive, "Nearer points are dropped.");
    p.number("max_range", max_range, {0.0, 10000.0}, "m", When::kLive, "Farther points are dropped.");
    p.number("box", box, {-10000.0, 10000.0}, "m", When::kStart,
             "Region of interest in the box frame: x_min, y_min, z_min, x_max, y_max, z_max; empty for all.");
    p.number(
        "body", body, {-1000.0, 1000.0}, "m", When::kStart,
        "Boxes in the box frame whose points are dropped as the robot's own, six numbers each, as in box.");
    p.number("voxel_size", voxel_size, {0.0, 10.0}, "m", When::kLive,
             "Side of the cubes of which each keeps one point; 0 keeps all, else at least 0.01.");
    p.rule([this] { return min_range <= max_range; }, "min_range must not exceed max_range");
    p.rule([this] { return azimuth_min != azimuth_max; }, "azimuth_min and azimuth_max must differ");
    p.rule([this] { return voxel_size == 0.0 || voxel_size >= 0.01; },
           "voxel_size must be 0 or at least 0.01");
    p.rule([this] { return box.size() <= 6 && areBoxes(box); },
           "box must hold 0 or 6 numbers, each min below its max");
    p.rule([this] { return areBoxes(body); },
           "body must hold 6 numbers for each box, each min below its max");
  }
};

/// What became of the points of one cloud; the drops count each point once, by the first test it failed.
struct FilterCounts {
  std::size_t in = 0, kept = 0;
  std::size_t non_finite = 0;
  std::size_t angle = 0;
  std::size_t range = 0;
  std::size_t box = 0;
  std::size_t body = 0;
  std::size_t merged = 0;  ///< stood for by another point of their voxel
};

/// Keeps its buffers from cloud to cloud.
class Filter {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit Filter(const FilterParams& params = {}) { setParams(params); }
  void setParams(const FilterParams& params);

  /// Writes the points that pass to `kept` (not `cloud` itself), in their order and unchanged.
  /// `T_box_sensor` carries the cloud into the frame of `box` and `body`; throws std::invalid_argument
  /// where it is not finite.
  FilterCounts run(const Cloud& cloud, Cloud& kept, const Transform& T_box_sensor = Transform::Identity());

 private:
  /// A sector of directions, its borders included. Cross products, because an arctangent a point costs more
  /// than all other tests together.
  struct Sector {
    Eigen::Vector2d begin, end;
    enum { kAll, kConvex, kReflex } shape;
    bool contains(const Point& p) const;
  };

  bool passes(const Point& p, const Eigen::Isometry3f& T_box_sensor, FilterCounts& counts) const;

  FilterParams params_;
  Sector sector_{};
  std::vector<Eigen::AlignedBox3f> box_, body_;
  Voxels voxels_;
  Cloud passed_;
};

}  // namespace field_fusion::core
