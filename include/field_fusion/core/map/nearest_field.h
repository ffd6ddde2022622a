#pragma once
// For each cell of a tile, the nearest cell that is occupied, and the wall that it belongs to.
#include <boost/smart_ptr/intrusive_ref_counter.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "field_fusion/core/map/tile.h"

namespace field_fusion::core {

/// What a scan's points are compared with: an occupied cell.
struct Wall {
  float x, y;              ///< [cells] from the corner of the field's tile: mean of its hits, on a wall moved onto its line
  float nx = 0, ny = 0;    ///< normal of the wall through it, its sign means nothing; 0: no wall, a point
  bool line() const { return nx != 0.f || ny != 0.f; }
};

class NearestField : public boost::intrusive_ref_counter<NearestField> {
 public:
  static constexpr int kReach = 8;               ///< [cells] between middles
  static constexpr int kMargin = kReach + 2;     ///< [cells] about a tile that its field depends on

  /// Of a cell by its place in the map; null: nothing is occupied within kReach.
  const Wall* at(int x, int y) const {
    const int i = Tile::index(x, y);
    const unsigned number = low_[i] | (high_.empty() ? 0u : unsigned{high_[i]} << 8);
    return number == 0 ? nullptr : &walls_[number - 1];
  }

 private:
  friend class FieldMaker;
  void set(int i, unsigned number) {
    low_[i] = static_cast<std::uint8_t>(number & 0xff);
    if (number > 0xff && high_.empty()) high_.assign(kTileCells, 0);
    if (!high_.empty()) high_[i] = static_cast<std::uint8_t>(number >> 8);
  }

  std::array<std::uint8_t, kTileCells> low_{};  // number of each cell's wall, from 1 on; 0: none
  std::vector<std::uint8_t> high_;              // its upper byte; empty: there are no more than 255
  std::vector<Wall> walls_;
};

/// The tile and those around it, row by row from low x and y; null where nothing is known.
using Neighbourhood = std::array<const Tile*, 9>;

/// Nearest by the middles of cells. All that have nothing occupied in reach are one.
boost::intrusive_ptr<NearestField> nearestField(const Neighbourhood& tiles);

}  // namespace field_fusion::core
