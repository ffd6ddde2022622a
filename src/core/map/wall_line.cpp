#include "field_fusion/core/map/wall_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr float kNarrow = 0.75f,
                kStrip = 1.f;  // [cells] from a line through the cell: to find its direction, to fit it

struct Direction {
  float nx, ny;
  float off(float x, float y) const { return nx * x + ny * y; }
};

/// Of four, the one with most cells on its line. Each cell counts once: the far face of a wall may have been
/// seen much more often. None where nearly as many lie across as along: a heap.
std::optional<Direction> roughNormal(const HitsAround& around) {
  constexpr float kHalf = 0.70710678f;
  constexpr std::array<Direction, 4> kNormals{{{1.f, 0.f}, {kHalf, kHalf}, {0.f, 1.f}, {kHalf, -kHalf}}};
  std::array<int, 4> cells{};
  for (std::size_t i = 0; i < kNormals.size(); ++i)
    for (int k = 0; k < around.number; ++k)
      cells[i] += std::abs(kNormals[i].off(around.x[k], around.y[k])) < kNarrow ? 1 : 0;
  const auto most = static_cast<std::size_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
  if (3 * cells[most] < 4 * cells[most ^ 2u]) return std::nullopt;  // the other is at a right angle
  return kNormals[most];
}

/// Sums over hits.
struct Moments {
  int cells = 0;
  float n = 0.f, x = 0.f, y = 0.f, xx = 0.f, xy = 0.f, yy = 0.f;

  Moments(const HitsAround& around, const Direction& normal) {
    for (int k = 0; k < around.number; ++k) {
      const float px = around.x[k], py = around.y[k], w = around.hits[k];
      if (std::abs(normal.off(px, py)) >= kStrip) continue;
      ++cells, n += w, x += w * px, y += w * py, xx += w * px * px, xy += w * px * py, yy += w * py * py;
    }
  }
};

}  // namespace

std::optional<WallLine> wallLine(const HitsAround& around) {
  const std::optional<Direction> rough = roughNormal(around);
  if (!rough) return std::nullopt;
  const Moments m(around, *rough);
  if (m.cells < 3) return std::nullopt;
  const float dxx = m.xx - m.x * m.x / m.n, dyy = m.yy - m.y * m.y / m.n, dxy = m.xy - m.x * m.y / m.n;
  const float a = dxx - dyy, b = 2.f * dxy, sum = dxx + dyy, spread = std::sqrt(a * a + b * b);
  if (spread < 0.8f * sum || sum < 0.6f * m.n)
    return std::nullopt;  // the axes differ too little, or are too short
  // the major axis is at half the angle of (a, b); its normal a right angle on
  const float c = std::sqrt(0.5f * (1.f + a / spread));
  const float along = std::copysign(std::sqrt(std::max(0.f, 1.f - c * c)), b);
  const Direction normal{-along, c};
  return WallLine{normal.nx, normal.ny, normal.off(m.x, m.y) / m.n};
}

}  // namespace field_fusion::core
