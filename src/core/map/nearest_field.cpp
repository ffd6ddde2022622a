#include "field_fusion/core/map/nearest_field.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

constexpr int kReach = NearestField::kReach, kMargin = NearestField::kMargin;
constexpr int kSide = kTileSide + 2 * kMargin;  // of the tile with what surrounds it
static_assert(kSide <= 64, "a row of it is the bits of one word");

/// What is occupied in and around the tile.
struct Surroundings {
  std::array<std::uint64_t, kSide> rows{};       // bit x: occupied
  std::array<std::array<const Cell*, kSide>, kSide> cells;

  bool occupied(int x, int y) const { return (rows[y] >> x & 1) != 0; }
};

void addTile(Surroundings& out, const Tile& tile, int left, int bottom, float threshold) {
  const int x0 = std::max(0, left), x1 = std::min(kSide, left + kTileSide);
  for (int y = std::max(0, bottom); y < std::min(kSide, bottom + kTileSide); ++y)
    for (int x = x0; x < x1; ++x) {
      const Cell& cell = tile.cells[(y - bottom) * kTileSide + (x - left)];
      if (cell.hits == 0 || static_cast<float>(cell.hits) < threshold * static_cast<float>(cell.visits)) continue;
      out.rows[y] |= std::uint64_t{1} << x;
      out.cells[y][x] = &cell;
    }
}

/// Direction of the wall through an occupied cell: the smaller principal axis of the hits around it.
void addNormal(const Surroundings& s, int x, int y, Nearest& out) {
  float n = 0.f, sx = 0.f, sy = 0.f, sxx = 0.f, sxy = 0.f, syy = 0.f;
  for (int v = -2; v <= 2; ++v) {
    std::uint64_t bits = s.rows[y + v] >> (x - 2) & 0x1f;
    for (; bits != 0; bits &= bits - 1) {
      const int u = __builtin_ctzll(bits) - 2;
      const Cell& cell = *s.cells[y + v][x + u];
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

/// The keys say squared distance and row of the nearest, so that one minimum finds both.
void fillTile(const Surroundings& s, NearestField& field) {
  std::array<RowNearest, kSide> rows;
  std::array<std::array<Nearest, kSide>, kSide> walls;  // of the occupied cells in reach
  std::array<std::uint64_t, kSide> known{};
  for (int y = kMargin - kReach; y < kSide - kMargin + kReach; ++y)
    if (s.rows[y] != 0) fillRow(s.rows[y], rows[y]);

  for (int y = 0; y < kTileSide; ++y) {
    std::array<std::int16_t, kTileSide> best;
    best.fill(RowNearest::kFar);
    for (int v = -kReach; v <= kReach; ++v) {
      if (s.rows[y + kMargin + v] == 0) continue;
      const auto& key = rows[y + kMargin + v].key;
      const auto add = static_cast<std::int16_t>(32 * v * v + v + kReach);
      for (int x = 0; x < kTileSide; ++x)
        best[x] = std::min<std::int16_t>(best[x], static_cast<std::int16_t>(key[x] + add));
    }
    for (int x = 0; x < kTileSide; ++x) {
      Nearest& out = field.cells[y * kTileSide + x];
      if (best[x] >= 32 * (kReach * kReach + 1)) continue;
      const int v = best[x] % 32 - kReach, row = y + kMargin + v, u = rows[row].offset[x], column = x + kMargin + u;
      Nearest& wall = walls[row][column];
      if ((known[row] >> column & 1) == 0) {
        wall = Nearest{};
        wall.kind = Nearest::kPoint;
        addNormal(s, column, row, wall);
        known[row] |= std::uint64_t{1} << column;
      }
      out = wall;
      out.x = static_cast<std::int16_t>(2048 * u + s.cells[row][column]->x / 32);
      out.y = static_cast<std::int16_t>(2048 * v + s.cells[row][column]->y / 32);
    }
  }
}

}  // namespace

boost::intrusive_ptr<NearestField> nearestField(const Neighbourhood& tiles, float threshold) {
  Surroundings s;
  for (int k = 0; k < 9; ++k)
    if (tiles[k])
      addTile(s, *tiles[k], kMargin + (k % 3 - 1) * kTileSide, kMargin + (k / 3 - 1) * kTileSide, threshold);
  boost::intrusive_ptr<NearestField> field(new NearestField);
  if (std::any_of(s.rows.begin(), s.rows.end(), [](std::uint64_t row) { return row != 0; })) fillTile(s, *field);
  return field;
}

}  // namespace field_fusion::core
