#include "field_fusion/core/map/nearest_field.h"

#include <Eigen/Core>

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

  /// [cells] mean of the hits of an occupied cell, from the corner of the surroundings.
  Eigen::Vector2f mean(int x, int y) const {
    const int u = x + kTileSide - kMargin, v = y + kTileSide - kMargin;  // from the corner of the first tile
    const Cell cell = tiles[v / kTileSide * 3 + u / kTileSide]->at(u, v);
    return {x + 0.5f + cell.x / (2.f * Cell::kHalf), y + 0.5f + cell.y / (2.f * Cell::kHalf)};
  }
};

void addTile(Surroundings& out, const Tile& tile, int left, int bottom) {
  constexpr std::uint64_t kInside = (std::uint64_t{1} << kSide) - 1;
  for (int y = std::max(0, bottom); y < std::min(kSide, bottom + kTileSide); ++y) {
    const std::uint64_t row = tile.occupied()[y - bottom];
    out.rows[y] |= (left < 0 ? row >> -left : row << left) & kInside;
  }
}

/// Direction of the wall through an occupied cell: the smaller principal axis of the hits around it.
void addNormal(const Surroundings& s, int x, int y, Wall& out) {
  float n = 0.f, sx = 0.f, sy = 0.f, sxx = 0.f, sxy = 0.f, syy = 0.f;
  for (int v = -2; v <= 2; ++v) {
    std::uint64_t bits = s.rows[y + v] >> (x - 2) & 0x1f;
    for (; bits != 0; bits &= bits - 1) {
      const int u = __builtin_ctzll(bits) - 2;
      const Eigen::Vector2f mean = s.mean(x + u, y + v);
      const float px = mean.x() - static_cast<float>(x), py = mean.y() - static_cast<float>(y);
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
  out.nx = -along, out.ny = c;
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
      const Eigen::Vector2f mean = s_.mean(x, y);
      field_.walls_.push_back({mean.x() - kMargin, mean.y() - kMargin});
      addNormal(s_, x, y, field_.walls_.back());
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
  Surroundings s{tiles};
  for (int k = 0; k < 9; ++k)
    if (tiles[k]) addTile(s, *tiles[k], kMargin + (k % 3 - 1) * kTileSide, kMargin + (k / 3 - 1) * kTileSide);
  if (std::all_of(s.rows.begin(), s.rows.end(), [](std::uint64_t row) { return row == 0; })) return kNothing;
  boost::intrusive_ptr<NearestField> field(new NearestField);
  FieldMaker(s, *field).fill();
  return field;
}

}  // namespace field_fusion::core
