#pragma once
// The straight wall through a cell of a grid, by the hits around it.
#include <array>
#include <optional>

namespace field_fusion::core {

/// Cells around one that was hit, itself too, each by the mean of its hits, from that of the one [cells].
struct HitsAround {
  static constexpr int kReach = 2;  ///< [cells] to each side
  static constexpr int kMost = (2 * kReach + 1) * (2 * kReach + 1);

  int number = 0;
  std::array<float, kMost> x, y, hits;

  void add(float dx, float dy, float count) { x[number] = dx, y[number] = dy, hits[number++] = count; }
};

struct WallLine {
  float nx, ny;  ///< normal of length 1; its sign means nothing
  float off;     ///< [cells] of the line from the mean of the one, along the normal
};

/// Line through the hits within one cell of the straight line through the one that most cells lie on: the
/// other face of a thin wall is not of it. None where fewer than three cells do, or where they are no line.
std::optional<WallLine> wallLine(const HitsAround& around);

}  // namespace field_fusion::core
