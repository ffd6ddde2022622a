#pragma once
// Maps as pictures of cells: what goes into messages and files.
#include <cstdint>
#include <vector>

#include "field_fusion/core/map/tile_map.h"

namespace field_fusion::core {

constexpr std::int8_t kUnknownCell = -1, kFreeCell = 0, kWallCell = 100;

/// Row by row from low y, as nav_msgs/OccupancyGrid has it: -1, or 0 (free) to 100 (occupied).
struct Occupancy {
  double resolution = 0.05;   ///< [m] side of a cell
  double x = 0.0, y = 0.0;    ///< [m] corner of the first cell
  int width = 0, height = 0;  ///< [cells]
  std::vector<std::int8_t> cells;
};

/// A rectangle of cells [x0, x0 + width) x [y0, y0 + height) of the lattice through the origin.
struct CellArea {
  int x0 = 0, y0 = 0, width = 0, height = 0;

  /// The square of `side` [m] about a place [m].
  static CellArea about(double x, double y, double side, double resolution);
  bool contains(int x, int y) const { return x >= x0 && x < x0 + width && y >= y0 && y < y0 + height; }
  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y - y0) * width + (x - x0); }
};

/// The area's picture: `cell(x, y)` of each of its cells.
template <class CellAt>
Occupancy pictureOf(const CellArea& area, double resolution, const CellAt& cell) {
  Occupancy out = {resolution, area.x0 * resolution, area.y0 * resolution, area.width, area.height, {}};
  out.cells.reserve(area.size());
  for (int y = area.y0; y < area.y0 + area.height; ++y)
    for (int x = area.x0; x < area.x0 + area.width; ++x) out.cells.push_back(cell(x, y));
  return out;
}

/// Draws maps that follow one another: only tiles whose revision is another than the one drawn there. The picture
/// grows by tiles and does not shrink.
class OccupancyDrawer {
 public:
  explicit OccupancyDrawer(double resolution = 0.05) { picture_.resolution = resolution; }

  const Occupancy& update(const TileMap& map);
  /// The next map may have the revisions of one before without being equal.
  void reset() { *this = OccupancyDrawer(picture_.resolution); }
  std::size_t drawn() const { return drawn_; }  ///< tiles, in the last update

 private:
  struct Slot {
    std::uint64_t revision = 0;  // 0: nothing drawn
    std::uint64_t turn = 0;      // of the last update that had a tile here
  };
  void cover(const TileMap& map);
  void draw(const Tile* tile, std::size_t slot);

  Occupancy picture_;
  int x0_ = 0, y0_ = 0, columns_ = 0, rows_ = 0;  // [tiles]
  std::vector<Slot> slots_;
  std::uint64_t turn_ = 0;
  std::size_t drawn_ = 0;
};

/// Hits / visits of the cells in the square of `side` [m] about (x, y) [m], in percent.
Occupancy occupancyAbout(const TileMap& map, double resolution, double x, double y, double side);

/// A map to go on from. Each of its cells counts as ten beams; cells from 50 on are walls. Throws
/// std::runtime_error where its cells are not those of a map of this resolution.
TileMap tileMapOf(const Occupancy& picture, double resolution, float occupied);

}  // namespace field_fusion::core
