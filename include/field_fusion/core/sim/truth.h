#pragma once
// What is true in a world at a time; no stage may see it.
#include <cstdint>
#include <string>
#include <vector>

#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

struct TruthBox {
  std::string name, label;
  Transform T_world_body;  ///< of the body's own frame
  Transform T_world_box;   ///< of the middle of its box; the axes are the body's
  Eigen::Vector3d size;    ///< [m] along them
};

/// A box for each body, in the world's order; swinging links as they are at `time` [s].
std::vector<TruthBox> truthAt(const World& world, double time);

/// Cells of a map, row by row from the south; column by column from the west.
struct TruthGrid {
  double cell = 0.05;                                ///< [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< [m] south-western corner, a multiple of `cell`
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> occupied;  ///< 1: a surface passes through the cell

  bool at(int column, int row) const {
    return occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)] != 0;
  }
  bool at(const Eigen::Vector2d& place) const;  ///< [m] world; false outside
};

struct SliceParams {
  double low = 0.3, high = 0.3;  ///< [m] the slice: what lies between, both included
  double cell = 0.05;            ///< [m]
  double margin = 0.5;           ///< [m] about the bodies
};

/// The surfaces of the bodies in a horizontal slice at `time`: every cell that one touches. Spheres and
/// cylinders as polyhedra that are within 0.3 % of their radius. The ground and the robot are not in it.
/// Throws std::invalid_argument for a slice upside down, a cell not above 0, or more than 1e8 cells.
TruthGrid occupancy(const World& world, double time, const SliceParams& slice);

}  // namespace field_fusion::core::sim
