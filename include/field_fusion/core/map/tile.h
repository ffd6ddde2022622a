#pragma once
// Squares of grid cells that maps share until one of them changes.
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace field_fusion::core {

/// Counts of one cell, as Gmapping keeps them (Grisetti et al. 2007): the map's probability is hits / visits.
struct Cell {
  static constexpr float kHalf = 32767.f;  ///< units of `x`, `y` in half a cell

  std::uint16_t hits = 0;    ///< beams that ended here
  std::uint16_t visits = 0;  ///< beams that ended here or went through
  std::int16_t x = 0, y = 0; ///< mean of the ends, from the middle of the cell

  /// A beam ended here, at [-0.5, 0.5] cells from the middle.
  void hit(float dx, float dy) {
    visit();
    ++hits;
    const float n = hits;
    x = static_cast<std::int16_t>(std::lround(x + (2.f * kHalf * dx - x) / n));
    y = static_cast<std::int16_t>(std::lround(y + (2.f * kHalf * dy - y) / n));
  }
  /// Full counts are halved: the probability stays, and new beams weigh no less than 1 in 65535.
  void visit() {
    if (visits == 0xffff) visits /= 2, hits /= 2;
    ++visits;
  }
  /// NaN where nothing is known.
  float probability() const { return static_cast<float>(hits) / static_cast<float>(visits); }
};
static_assert(sizeof(Cell) == 8, "a tile is 8 KiB");

constexpr int kTileBits = 5;
constexpr int kTileSide = 1 << kTileBits;  ///< [cells]
constexpr int kTileCells = kTileSide * kTileSide;

struct Tile : boost::intrusive_ref_counter<Tile> {
  std::array<Cell, kTileCells> cells{};
  std::array<std::uint32_t, kTileSide> occupied{};  ///< bit x of word y: the cell is a wall, kept by TileMap
  std::uint64_t revision = 0;  ///< tiles of equal revision at one place are equal

  /// By the cell's place in the map.
  Cell& at(int x, int y) { return cells[index(x, y)]; }
  const Cell& at(int x, int y) const { return cells[index(x, y)]; }
  static int index(int x, int y) { return (y & (kTileSide - 1)) * kTileSide + (x & (kTileSide - 1)); }
};

/// Makes `shared` this holder's own, by a copy where others hold it too. Only its holders can hand out more
/// references, so that who finds itself alone stays alone.
template <class T>
T& own(boost::intrusive_ptr<T>& shared) {
  if (!shared)
    shared = new T;
  else if (shared->use_count() > 1)
    shared = new T(*shared);
  return *shared;
}

}  // namespace field_fusion::core
