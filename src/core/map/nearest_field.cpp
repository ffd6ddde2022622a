#include "field_fusion/core/map/nearest_field.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

constexpr int kReach = NearestField::kReach, kMargin = NearestField::kMargin;
constexpr int kSide = kTileSide + 2 * kMargin;  // of the tile with what surrounds it
static_assert(kSide <= 64, "a row of it is the bits of one word");

/// What is occupied in and around the tile.
struct Surroundings {
  const Neighbourhood& tiles;
  std::array<std::uint64_t, kSide> rows{};  // bit x: occupied

  const Cell& cell(int x, int y) const {
    const int u = x + kTileSide - kMargin, v = y + kTileSide - kMargin;  // from the corner of the first tile
    return tiles[v / kTileSide * 3 + u / kTileSide]->at(u, v);
  }
};

void addTile(Surroundings& out, const Tile& tile, int left, int bottom) {
  constexpr std::uint64_t kInside = (std::uint64_t{1} << kSide) - 1;
  for (int y = std::max(0, bottom); y < std::min(kSide, bottom + kTileSide); ++y) {
    const std::uint64_t row = tile.occupied[y - bottom];
    out.rows[y] |= (left < 0 ? row >> -left : row << left) & kInside;
  }
}

/// Direction of the wall through an occupied cell: the smaller principal axis of the hits around it.
void addNormal(const Surroundings& s, int x, int y, Nearest& out) {
  float n = 0.f, sx = 0.f, sy = 0.f, sxx = 0.f, sxy = 0.f, syy = 0.f;
  for (int v = -2; v <= 2; ++v) {
    std::uint64_t bits = s.rows[y + v] >> (x - 2) & 0x1f;
    for (; bits != 0; bits &= bits - 1) {
      const int u = __builtin_ctzll(bits) - 2;
      const Cell& cell = s.cell(x + u, y + v);
      const float px = static_cast<float>(u) + cell.x / (2.f * Cell::kHalf);
      const float py = static_cast<float>(v) + cell.y / (2.f * Cell::kHalf);
      n += 1.f, sx += px, sy += py, sxx += px * px, sxy += px * py, syy += py * py;
    }
  }
  if (n < 3.f) return;
  const float a = (sxx - sx * sx / n) - (syy - sy * sy / n), b = 2.f * (sxy - sx * sy / n);
  const float sum = (sxx - sx * sx / n) + (syy - sy * sy / n), spread = std::sqrt(a * a + b * b);
  if (spread < 0.8f * sum || sum < 0.6f * n) return;  // no wall: the axes differ too little, or too short
  // the major axis is at half the angle of (a, b); its normal a right angle on
  const float c = std::sqrt(0.5f * (1.f + a / spread));
  const float along = std::copysign(std::sqrt(std::max(0.f, 1.f - c * c)), b);
  out.nx = static_cast<std::int8_t>(std::lround(-127.f * along));
  out.ny = static_cast<std::int8_t>(std::lround(127.f * c));
  out.kind = Nearest::kLine;
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

/// The walls through occupied cells, each computed once.
class Walls {
 public:
  explicit Walls(const Surroundings& s) : s_(s) {}

  const Nearest& at(int x, int y) {
    Nearest& wall = walls_[y][x];
    if ((known_[y] >> x & 1) == 0) {
      known_[y] |= std::uint64_t{1} << x;
      const Cell& cell = s_.cell(x, y);
      wall = {static_cast<std::int16_t>(cell.x / 32), static_cast<std::int16_t>(cell.y / 32), 0, 0, Nearest::kPoint};
      addNormal(s_, x, y, wall);
    }
    return wall;
  }

 private:
  const Surroundings& s_;
  std::array<std::uint64_t, kSide> known_{};
  std::array<std::array<Nearest, kSide>, kSide> walls_;
};

void fillTile(const Surroundings& s, NearestField& field) {
  std::array<RowNearest, kSide> rows;
  for (int y = kMargin - kReach; y < kSide - kMargin + kReach; ++y)
    if (s.rows[y] != 0) fillRow(s.rows[y], rows[y]);
  Walls walls(s);
  for (int y = 0; y < kTileSide; ++y) {
    const Row best = nearestRows(s, rows, y);
    for (int x = 0; x < kTileSide; ++x) {
      if (best[x] >= 32 * (kReach * kReach + 1)) continue;
      const int v = best[x] % 32 - kReach, u = rows[y + kMargin + v].offset[x];
      Nearest& out = field.cells[y * kTileSide + x];
      out = walls.at(x + kMargin + u, y + kMargin + v);
      out.x = static_cast<std::int16_t>(out.x + 2048 * u), out.y = static_cast<std::int16_t>(out.y + 2048 * v);
    }
  }
}

}  // namespace

boost::intrusive_ptr<NearestField> nearestField(const Neighbourhood& tiles) {
  Surroundings s{tiles};
  for (int k = 0; k < 9; ++k)
    if (tiles[k]) addTile(s, *tiles[k], kMargin + (k % 3 - 1) * kTileSide, kMargin + (k / 3 - 1) * kTileSide);
  boost::intrusive_ptr<NearestField> field(new NearestField);
  if (std::any_of(s.rows.begin(), s.rows.end(), [](std::uint64_t row) { return row != 0; })) fillTile(s, *field);
  return field;
}

}  // namespace field_fusion::core
