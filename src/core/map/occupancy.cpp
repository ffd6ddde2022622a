#include "field_fusion/core/map/occupancy.h"

#include <algorithm>
#include <climits>
#include <limits>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

constexpr std::uint64_t kLoaded = std::numeric_limits<std::uint64_t>::max();  // revision that no scan has

/// [cells] of a corner, which must lie between cells.
int wholeCells(double metres, double resolution) {
  const double cells = metres / resolution, whole = std::round(cells);
  if (!(std::abs(cells - whole) < 0.02 && std::abs(whole) < TileMap::kMaxCell))
    throw std::runtime_error("the map's origin " + std::to_string(metres) + " m is no multiple of its resolution");
  return static_cast<int>(whole);
}

}  // namespace

const Occupancy& OccupancyDrawer::update(const TileMap& map) {
  cover(map);
  ++turn_, drawn_ = 0;
  map.forEach([&](TilePlace place, const Tile& tile, const NearestField*) {
    const std::size_t at = static_cast<std::size_t>(place.y - y0_) * columns_ + (place.x - x0_);
    slots_[at].turn = turn_;
    if (slots_[at].revision == tile.revision) return;
    slots_[at].revision = tile.revision;
    draw(&tile, at);
  });
  for (std::size_t at = 0; at < slots_.size(); ++at)
    if (slots_[at].turn != turn_ && slots_[at].revision != 0) slots_[at].revision = 0, draw(nullptr, at);
  return picture_;
}

/// Makes room for every tile, and keeps what is drawn.
void OccupancyDrawer::cover(const TileMap& map) {
  const bool empty = slots_.empty();
  int x0 = empty ? INT_MAX : x0_, y0 = empty ? INT_MAX : y0_;
  int x1 = empty ? INT_MIN : x0_ + columns_, y1 = empty ? INT_MIN : y0_ + rows_;
  map.forEach([&](TilePlace p, const Tile&, const NearestField*) {
    x0 = std::min(x0, p.x), y0 = std::min(y0, p.y), x1 = std::max(x1, p.x + 1), y1 = std::max(y1, p.y + 1);
  });
  if (x0 >= x1 || (x0 == x0_ && y0 == y0_ && x1 - x0 == columns_ && y1 - y0 == rows_)) return;
  Occupancy grown = {picture_.resolution, x0 * kTileSide * picture_.resolution, y0 * kTileSide * picture_.resolution,
                     (x1 - x0) * kTileSide, (y1 - y0) * kTileSide, {}};
  grown.cells.assign(static_cast<std::size_t>(grown.width) * grown.height, kUnknownCell);
  const std::size_t right = static_cast<std::size_t>(empty ? 0 : (x0_ - x0) * kTileSide);
  for (int y = 0; y < picture_.height; ++y)
    std::copy_n(picture_.cells.begin() + static_cast<std::ptrdiff_t>(y) * picture_.width, picture_.width,
                grown.cells.begin() + (static_cast<std::ptrdiff_t>(y) + (y0_ - y0) * kTileSide) * grown.width + right);
  std::vector<Slot> slots(static_cast<std::size_t>(x1 - x0) * (y1 - y0));
  for (int y = 0; y < rows_; ++y)
    std::copy_n(slots_.begin() + static_cast<std::ptrdiff_t>(y) * columns_, columns_,
                slots.begin() + (static_cast<std::ptrdiff_t>(y) + y0_ - y0) * (x1 - x0) + (x0_ - x0));
  picture_ = std::move(grown), slots_ = std::move(slots);
  x0_ = x0, y0_ = y0, columns_ = x1 - x0, rows_ = y1 - y0;
}

void OccupancyDrawer::draw(const Tile* tile, std::size_t slot) {
  ++drawn_;
  const std::size_t column = slot % columns_, row = slot / columns_;
  for (int y = 0; y < kTileSide; ++y) {
    std::int8_t* out = &picture_.cells[(row * kTileSide + y) * picture_.width + column * kTileSide];
    for (int x = 0; x < kTileSide; ++x) {
      out[x] = !tile || !tile->seen(x, y) ? kUnknownCell : tile->isOccupied(x, y) ? kWallCell : kFreeCell;
    }
  }
}

CellArea CellArea::about(double x, double y, double side, double resolution) {
  const int cells = static_cast<int>(std::lround(side / resolution));
  return {static_cast<int>(std::lround(x / resolution)) - cells / 2,
          static_cast<int>(std::lround(y / resolution)) - cells / 2, cells, cells};
}

Occupancy occupancyAbout(const TileMap& map, double resolution, double x, double y, double side) {
  return pictureOf(CellArea::about(x, y, side, resolution), resolution, [&map](int u, int v) {
    const Cell cell = map.cell(u, v);
    return cell.visits > 0 ? static_cast<std::int8_t>(std::lround(100.f * cell.probability())) : kUnknownCell;
  });
}

TileMap tileMapOf(const Occupancy& picture, double resolution, float occupied) {
  constexpr std::uint16_t kBeams = 10;
  if (std::abs(picture.resolution / resolution - 1.0) > 1e-3)
    throw std::runtime_error("the map's resolution is " + std::to_string(picture.resolution) + " m, not " +
                             std::to_string(resolution));
  TileMap map(occupied);
  const int x0 = wholeCells(picture.x, resolution), y0 = wholeCells(picture.y, resolution);
  for (std::size_t i = 0; i < picture.cells.size(); ++i) {
    const std::int8_t value = picture.cells[i];
    if (value == kUnknownCell) continue;
    const int x = x0 + static_cast<int>(i % picture.width), y = y0 + static_cast<int>(i / picture.width);
    Tile& tile = map.writable({x >> kTileBits, y >> kTileBits});
    const bool wall = value >= 50;
    tile.revision = kLoaded;
    tile.set(x, y, {wall ? kBeams : std::uint16_t{0}, kBeams, 0, 0}), tile.setOccupied(x, y, wall);
  }
  return map;
}

}  // namespace field_fusion::core
