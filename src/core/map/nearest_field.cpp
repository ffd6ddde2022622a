#include "field_fusion/core/map/nearest_field.h"

#include <algorithm>

#include "field_fusion/core/map/wall_line.h"

namespace field_fusion::core {
namespace {

constexpr int kReach = NearestField::kReach, kMargin = NearestField::kMargin;
constexpr int kSide = kTileSide + 2 * kMargin;  // of the tile with what surrounds it
static_assert(kMargin >= kReach + HitsAround::kReach);
static_assert(kSide <= 64, "a row of it is the bits of one word");

/// What was hit in and around the tile, and what of it is occupied.
class Surroundings {
 public:
  explicit Surroundings(const Neighbourhood& tiles) {
    for (int k = 0; k < 9; ++k)
      if (tiles[k]) add(*tiles[k], kMargin + (k % 3 - 1) * kTileSide, kMargin + (k / 3 - 1) * kTileSide);
  }
  bool empty() const {
    return std::all_of(rows.begin(), rows.end(), [](std::uint64_t row) { return row == 0; });
  }
  /// The wall through an occupied cell. All that was ever hit says where it is, occupied or not: of a wall between two
  /// rows of cells, beams cross the nearer, so that only the farther may count as occupied, and that has the long ranges alone.
  Wall wallThrough(int x, int y) const;

  std::array<std::uint64_t, kSide> rows{};  // bit x: occupied

 private:
  struct Hits {
    float x, y, number;  // mean [cells] from the corner of the surroundings
  };

  void add(const Tile& tile, int left, int bottom) {
    constexpr std::uint64_t kInside = (std::uint64_t{1} << kSide) - 1;
    for (int y = std::max(0, bottom); y < std::min(kSide, bottom + kTileSide); ++y) {
      const std::uint64_t row = tile.occupied()[y - bottom];
      rows[y] |= (left < 0 ? row >> -left : row << left) & kInside;
      tile.forEachHit(y - bottom, [&](int column, const Cell& cell) {
        const int x = left + column;
        if (x < 0 || x >= kSide || cell.hits == 0) return;
        struck_[y] |= std::uint64_t{1} << x;
        hits_[y * kSide + x] = {x + 0.5f + cell.x / (2.f * Cell::kHalf), y + 0.5f + cell.y / (2.f * Cell::kHalf),
                                static_cast<float>(cell.hits)};
      });
    }
  }

  std::array<std::uint64_t, kSide> struck_{};  // bit x: was hit
  std::array<Hits, kSide * kSide> hits_;       // of those that were; the rest is left as it is
};

Wall Surroundings::wallThrough(int x, int y) const {
  constexpr int kAround = HitsAround::kReach;
  const Hits& own = hits_[y * kSide + x];
  HitsAround around;
  for (int v = y - kAround; v <= y + kAround; ++v)
    for (std::uint64_t left = struck_[v] >> (x - kAround) & ((1u << (2 * kAround + 1)) - 1u); left != 0; left &= left - 1) {
      const Hits& hits = hits_[v * kSide + x - kAround + __builtin_ctzll(left)];
      around.add(hits.x - own.x, hits.y - own.y, hits.number);
    }
  Wall out{own.x - kMargin, own.y - kMargin};
  if (const auto line = wallLine(around)) {
    out.nx = line->nx, out.ny = line->ny;
    out.x += line->off * line->nx, out.y += line->off * line->ny;
  }
  return out;
}

/// For one row of the surroundings, the occupied cell of that row that is nearest to each of the tile's columns.
struct RowNearest {
  static constexpr std::int16_t kFar = 16000;
  std::array<std::int16_t, kTileSide> key;   // 32 * squared distance, or kFar
  std::array<std::int8_t, kTileSide> offset; // [cells] to it
};

void fillRow(std::uint64_t row, RowNearest& out) {
  for (int x = 0; x < kTileSide; ++x) {
    const int at = x + kMargin;
    const std::uint64_t right = row >> at, left = row << (63 - at);
    const int to_right = right ? __builtin_ctzll(right) : 64, to_left = left ? __builtin_clzll(left) : 64;
    const int distance = std::min(to_left, to_right);
    out.offset[x] = static_cast<std::int8_t>(to_right <= to_left ? to_right : -to_left);
    out.key[x] = distance <= kReach ? static_cast<std::int16_t>(32 * distance * distance) : RowNearest::kFar;
  }
}

using Row = std::array<std::int16_t, kTileSide>;

/// The keys say squared distance and row of the nearest, so that one minimum finds both.
Row nearestRows(const Surroundings& s, const std::array<RowNearest, kSide>& rows, int y) {
  Row best;
  best.fill(RowNearest::kFar);
  for (int v = -kReach; v <= kReach; ++v) {
    if (s.rows[y + kMargin + v] == 0) continue;
    const Row& key = rows[y + kMargin + v].key;
    const auto add = static_cast<std::int16_t>(32 * v * v + v + kReach);
    for (int x = 0; x < kTileSide; ++x)
      best[x] = std::min<std::int16_t>(best[x], static_cast<std::int16_t>(key[x] + add));
  }
  return best;
}

}  // namespace

class FieldMaker {
 public:
  FieldMaker(const Surroundings& s, NearestField& field) : s_(s), field_(field) {}

  void fill() {
    std::array<RowNearest, kSide> rows;
    for (int y = kMargin - kReach; y < kSide - kMargin + kReach; ++y)
      if (s_.rows[y] != 0) fillRow(s_.rows[y], rows[y]);
    for (int y = 0; y < kTileSide; ++y) {
      const Row best = nearestRows(s_, rows, y);
      for (int x = 0; x < kTileSide; ++x) {
        if (best[x] >= 32 * (kReach * kReach + 1)) continue;
        const int v = best[x] % 32 - kReach, u = rows[y + kMargin + v].offset[x];
        field_.set(y * kTileSide + x, wall(x + kMargin + u, y + kMargin + v));
      }
    }
    field_.walls_.shrink_to_fit();
  }

 private:
  /// Number of the wall through an occupied cell of the surroundings; each is computed once.
  std::uint16_t wall(int x, int y) {
    std::uint16_t& number = number_[y][x];
    if (number == 0) {
      field_.walls_.push_back(s_.wallThrough(x, y));
      number = static_cast<std::uint16_t>(field_.walls_.size());
    }
    return number;
  }

  const Surroundings& s_;
  NearestField& field_;
  std::array<std::array<std::uint16_t, kSide>, kSide> number_{};
};

boost::intrusive_ptr<NearestField> nearestField(const Neighbourhood& tiles) {
  static const boost::intrusive_ptr<NearestField> kNothing(new NearestField);
  const Surroundings s(tiles);
  if (s.empty()) return kNothing;
  boost::intrusive_ptr<NearestField> field(new NearestField);
  FieldMaker(s, *field).fill();
  return field;
}

}  // namespace field_fusion::core
