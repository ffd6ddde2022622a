#pragma once
// Squares of grid cells that maps share until one of them changes.
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace field_fusion::core {

/// Counts of one cell, as Gmapping keeps them (Grisetti et al. 2007): the map's probability is hits / visits.
struct Cell {
  static constexpr float kHalf = 32767.f;  ///< units of `x`, `y` in half a cell

  std::uint16_t hits = 0;    ///< beams that ended here
  std::uint16_t visits = 0;  ///< beams that ended here or went through
  std::int16_t x = 0, y = 0; ///< mean of the ends, from the middle of the cell

  /// NaN where nothing is known.
  float probability() const { return static_cast<float>(hits) / static_cast<float>(visits); }
};

constexpr int kTileBits = 5;
constexpr int kTileSide = 1 << kTileBits;  ///< [cells]
constexpr int kTileCells = kTileSide * kTileSide;

/// Most cells are free or unknown: they have one byte, which stops at 255 visits. Those that were ever hit have full counts:
/// a wall that forgot its first beams would drift along with the robot. Cells are named by their place in the map.
class Tile : public boost::intrusive_ref_counter<Tile> {
 public:
  using Bits = std::array<std::uint32_t, kTileSide>;  ///< bit x of word y

  Cell at(int x, int y) const { return wasHit(x, y) ? struck_[rank(x, y)] : Cell{0, visits_[index(x, y)], 0, 0}; }
  bool seen(int x, int y) const { return visits_[index(x, y)] > 0; }
  bool wasHit(int x, int y) const { return (hit_[row(y)] >> column(x) & 1u) != 0; }

  /// Calls visit(x, cell) for the cells of one row that were ever hit, from low x on.
  template <class Visit>
  void forEachHit(int y, const Visit& visit) const {
    const Cell* cell = struck_.data() + before_[y];
    for (std::uint32_t left = hit_[y]; left != 0; left &= left - 1) visit(__builtin_ctz(left), *cell++);
  }

  /// A beam went through. Full counts are halved: the probability stays, and new beams weigh no less than 1 in 65535.
  void visit(int x, int y) {
    if (wasHit(x, y)) return count(struck_[rank(x, y)]);
    if (std::uint8_t& visits = visits_[index(x, y)]; visits < 0xff) ++visits;
  }
  /// A beam ended here, at [-0.5, 0.5] cells from the middle.
  void hit(int x, int y, float dx, float dy);
  void set(int x, int y, const Cell& cell);

  /// Which cells are walls; kept by who writes.
  const Bits& occupied() const { return occupied_; }
  bool isOccupied(int x, int y) const { return (occupied_[row(y)] >> column(x) & 1u) != 0; }
  void setOccupied(int x, int y, bool occupied) {
    const std::uint32_t bit = 1u << column(x);
    occupied ? occupied_[row(y)] |= bit : occupied_[row(y)] &= ~bit;
  }

  std::uint64_t revision = 0;  ///< tiles of equal revision at one place are equal

  static int index(int x, int y) { return row(y) * kTileSide + column(x); }

 private:
  static int row(int y) { return y & (kTileSide - 1); }
  static int column(int x) { return x & (kTileSide - 1); }
  /// Where in `struck_` the cell is, or would be.
  int rank(int x, int y) const {
    return before_[row(y)] + __builtin_popcount(hit_[row(y)] & ((1u << column(x)) - 1u));
  }
  static void count(Cell& cell) {
    if (cell.visits == 0xffff) cell.visits /= 2, cell.hits /= 2;
    ++cell.visits;
  }
  Cell& struck(int x, int y);

  std::array<std::uint8_t, kTileCells> visits_{};
  Bits hit_{}, occupied_{};
  std::array<std::uint16_t, kTileSide> before_{};  // cells of `struck_` in the rows before
  std::vector<Cell> struck_;                       // those of `hit_`, in their order
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
