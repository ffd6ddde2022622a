#include "field_fusion/core/map/tile.h"

namespace field_fusion::core {

void Tile::hit(int x, int y, float dx, float dy) {
  Cell& cell = struck(x, y);
  count(cell);
  ++cell.hits;
  const float n = cell.hits;
  const auto mean = [n](std::int16_t before, float d) {
    return static_cast<std::int16_t>(std::lround(before + (2.f * Cell::kHalf * d - before) / n));
  };
  cell.x = mean(cell.x, dx), cell.y = mean(cell.y, dy);
}

void Tile::set(int x, int y, const Cell& cell) {
  if (cell.hits > 0 || wasHit(x, y))
    struck(x, y) = cell;
  visits_[index(x, y)] = static_cast<std::uint8_t>(cell.visits < 0xff ? cell.visits : 0xff);
}

/// With what was counted before its first hit.
Cell& Tile::struck(int x, int y) {
  const int at = rank(x, y);
  if (wasHit(x, y)) return struck_[at];
  std::uint8_t& visits = visits_[index(x, y)];
  if (struck_.size() == struck_.capacity()) struck_.reserve(struck_.size() + struck_.size() / 8 + 2);  // not twice: thousands of tiles
  struck_.insert(struck_.begin() + at, Cell{0, visits, 0, 0});
  visits = 0xff;  // seen
  hit_[row(y)] |= 1u << column(x);
  for (int v = row(y) + 1; v < kTileSide; ++v) ++before_[v];
  return struck_[at];
}

}  // namespace field_fusion::core
