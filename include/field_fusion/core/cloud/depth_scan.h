#pragma once
// Stage `depth_scan`: a depth image or a cloud as the scan of a made-up planar scanner (paper 004,
// section 4.1).
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/cloud/boxes.h"
#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

struct DepthScanParams {
  double azimuth_step = 0.5;
  double range_min = 0.1;
  double range_max = 8.0;
  double cell_length = 0.05;
  int min_points = 3;
  double min_height = 0.05;
  double max_height = 0.6;
  double floor_angle = 0.5;
  std::vector<double> body;

  void declare(Params& p) {
    p.number("azimuth_step", azimuth_step, {0.05, 45.0}, "deg", When::kLive, "Between beams of the scan.");
    p.number("range_min", range_min, {0.0, 100.0}, "m", When::kLive, "Nearer points are dropped.");
    p.number("range_max", range_max, {0.1, 100.0}, "m", When::kLive, "Farther points are dropped.");
    p.number(
        "cell_length", cell_length, {0.005, 1.0}, "m", When::kLive,
        "Points of a beam count together along so much of it: the voxel filter of paper 004, in cells of a "
        "scan.");
    p.number("min_points", min_points, {1, 10000}, "points", When::kLive, "A cell with fewer is noise.");
    p.number("min_height", min_height, {-10.0, 10.0}, "m", When::kLive,
             "Over the ground; what is lower is floor.");
    p.number("max_height", max_height, {-10.0, 100.0}, "m", When::kLive,
             "Over the ground; what is higher is passed below.");
    p.number("floor_angle", floor_angle, {0.0, 20.0}, "deg", When::kLive,
             "min_height rises by this angle with the distance: so well the camera's tilt is known.");
    p.number("body", body, {-100.0, 100.0}, "m", When::kStart,
             "Boxes in base_frame whose points are the robot's own: x_min, y_min, z_min, x_max, y_max, z_max "
             "each.");
    p.rule([this] { return range_min < range_max; }, "range_min must be below range_max");
    p.rule([this] { return min_height < max_height; }, "min_height must be below max_height");
    p.rule([this] { return areBoxes(body); },
           "body must hold 6 numbers for each box, each min below its max");
  }
};

/// Rows of depth along the optical axis, by a camera without distortion (x right, y down, z ahead).
template <class Pixel>
struct DepthImage {
  int width = 0, height = 0;
  const Pixel* pixels = nullptr;
  std::size_t row = 0;                            ///< [pixels] from one row to the next
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]
};

/// Where a sensor stands when it measures.
struct ScanPlace {
  Transform T_plane_sensor = Transform::Identity();  ///< the plane of the scan is level, its z is up
  Transform T_plane_base = Transform::Identity();    ///< of the robot whose own points are dropped
  double plane_height = 0.0;                         ///< [m] of the plane over the ground
};

struct DepthScanCounts {
  std::size_t seen = 0;  ///< pixels or points with a place
  std::size_t floor = 0, above = 0, out_of_range = 0, body = 0;
  std::size_t kept = 0;
  std::size_t noise = 0;  ///< of the kept, those in cells of too few
};

/// Each beam has the nearest point of its first cell that is no noise. A beam along which something was seen,
/// if only floor, is free where nothing stands; one along which nothing was seen is NaN. Keeps its buffers.
class DepthScanner {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit DepthScanner(const DepthScanParams& params = {}) { setParams(params); }
  void setParams(const DepthScanParams& params);

  /// Millimetres (0: none) or metres (0, NaN, infinity: none), as REP-118 has them.
  DepthScanCounts run(const DepthImage<std::uint16_t>& image, const ScanPlace& place, Scan& scan);
  DepthScanCounts run(const DepthImage<float>& image, const ScanPlace& place, Scan& scan);
  DepthScanCounts run(const Cloud& cloud, const ScanPlace& place, Scan& scan);

 private:
  struct Cell {
    float nearest;
    std::uint32_t count;
  };
  template <class Pixel>
  DepthScanCounts runImage(const DepthImage<Pixel>& image, const ScanPlace& place, Scan& scan);
  void begin(const ScanPlace& place, std::size_t batch);
  void addBatch(std::size_t count);
  void add(float x, float y, float z, float range, std::size_t beam);
  DepthScanCounts finish(Scan& scan);

  DepthScanParams params_;
  ScanBins bins_{0.0, radians(1.0)};
  std::vector<Eigen::AlignedBox3f> body_;
  float body_reach_ = 0.f;  // [m] from the base, beyond it nothing is the robot's own
  float own_range_ = 0.f;   // [m] likewise from the plane's origin
  std::size_t cells_ = 0;   // of a beam
  std::vector<Cell> grid_;  // beam by beam
  std::vector<char> seen_;  // of each beam
  std::vector<Eigen::Vector3f> columns_;
  std::vector<float> x_, y_, z_, range_;  // of some points in the plane; z NaN: none
  std::vector<std::uint32_t> beam_;       // of them
  Eigen::Isometry3f T_base_plane_ = Eigen::Isometry3f::Identity();
  float low_ = 0.f, high_ = 0.f, slope_ = 0.f;  // heights over the plane
  DepthScanCounts counts_;
};

}  // namespace field_fusion::core
