#pragma once
// For each cell of a tile, the nearest cell that is occupied, and the wall that it belongs to.
#include <boost/smart_ptr/intrusive_ref_counter.hpp>

#include <array>
#include <cstdint>

#include "field_fusion/core/map/tile.h"

namespace field_fusion::core {

/// What a scan's point in one cell is compared with.
struct Nearest {
  static constexpr float kUnit = 1.f / 2048.f;  ///< [cells] of `x`, `y`
  enum Kind : std::uint8_t { kNone, kPoint, kLine };

  std::int16_t x, y;   ///< mean of the nearest cell's hits, from the middle of this cell
  std::int8_t nx, ny;  ///< kLine: the wall's normal, times 127; its sign means nothing
  Kind kind;           ///< kNone: nothing occupied within NearestField::kReach
};

struct NearestField : boost::intrusive_ref_counter<NearestField> {
  static constexpr int kReach = 8;               ///< [cells] between middles
  static constexpr int kMargin = kReach + 2;     ///< [cells] about a tile that its field depends on
  std::array<Nearest, kTileCells> cells{};

  const Nearest& at(int x, int y) const { return cells[Tile::index(x, y)]; }
};

/// The tile and those around it, row by row from low x and y; null where nothing is known.
using Neighbourhood = std::array<const Tile*, 9>;

/// Nearest by the middles of cells.
boost::intrusive_ptr<NearestField> nearestField(const Neighbourhood& tiles);

}  // namespace field_fusion::core
