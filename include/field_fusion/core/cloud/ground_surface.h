#pragma once
// Ground that is no plane: its local height over one, grown cell by cell outwards from the sensor.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/plane.h"

namespace field_fusion::core {

/// How far the ground may depart from a plane.
struct SurfaceLimits {
  double slope = 0.0;  ///< [rad] against the plane, seen from the sensor and from cell to cell
  double step = 0.0;   ///< [m] up or down from where the ground nearer to the sensor leads
};

/// A grid of cells of one metre around the sensor's foot. Under the sensor the ground is the plane. Farther
/// out a cell's ground is the mean of its points within the step of the height expected there: the one to
/// which the cells next to it and nearer to the sensor lead, going on with their slope or level, or, from
/// above, the plane's; that which most points confirm. Where more points lie around this height than on it,
/// there is a body or a mirror image, and the cell keeps what it expects, as an empty cell does. Keeps its
/// buffers from cloud to cloud.
class GroundSurface {
 public:
  /// [m] Half the grid's side. The ground farther out is as high as at the border.
  static constexpr int kHalfSide = 64;

  GroundSurface();

  /// Sets `heights` [m] above the local ground of the points of `cloud` listed in `usable`, which must be
  /// finite. Given the plane, the order of the points changes nothing, not even the last digit.
  void measure(const Cloud& cloud, const std::vector<std::uint32_t>& usable, const Plane& plane,
               const SurfaceLimits& limits, std::vector<double>& heights);

 private:
  /// A cell's place in the order of distance from the sensor; it names the cell.
  using Rank = std::uint32_t;
  struct Cell {
    float distance;           ///< [m] from the sensor's foot
    Eigen::Vector2f outward;  ///< unit vector
    IndexRange inner;         ///< in inner_
  };
  /// A cell next to another and nearer to the sensor.
  struct Inner {
    Rank rank;
    float weight;
    Eigen::Vector2f way;  ///< [m] from its middle to the other's
  };
  struct Patch {
    float height = 0.f;           ///< [m] over the plane, in the middle of the cell
    Eigen::Vector2f slope{0, 0};  ///< against the plane
    float gap = 1.f;              ///< [cells] since ground was last seen on the way here; 1 where it is seen
  };
  /// Of the ground in a cell.
  struct Sight {
    std::uint32_t points = 0;
    float error = 0.f;  ///< [m] mean height over the one expected
  };
  struct Place {
    Rank rank;
    Eigen::Vector2f offset;  ///< [m] from the middle of the cell
  };

  void place(const Cloud& cloud, const std::vector<std::uint32_t>& usable, const Plane& plane,
             std::vector<double>& heights);
  void sort(const std::vector<double>& heights);
  void grow(const SurfaceLimits& limits);
  Patch settle(Rank rank, float step) const;
  Patch expected(const Cell& cell, float slope_kept) const;
  Sight look(Rank rank, float height, float step) const;

  std::vector<Rank> rank_;  // of each cell of the grid, row by row
  std::vector<Cell> cells_;
  std::vector<Inner> inner_;
  std::vector<Patch> patches_;        // of each cell
  std::vector<Place> places_;         // of each usable point
  std::vector<std::uint32_t> start_;  // of each cell in ticks_, and the end
  std::vector<std::int32_t>
      ticks_;  // heights over the plane [0.1 mm], by cell; sums of integers know no order
};

}  // namespace field_fusion::core
