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
