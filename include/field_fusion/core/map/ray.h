#pragma once
// The cells that a ray goes through (Amanatides and Woo 1987).
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace field_fusion::core {

/// Calls visit(x, y) for every cell that the straight way from (x0, y0) to (x1, y1) [cells] enters, in order,
/// the first and the last too. Cell (i, j) is [i, i + 1) x [j, j + 1). What is visited is connected by sides:
/// through a corner the way takes one of the two neighbours.
template <class Visit>
void traverse(double x0, double y0, double x1, double y1, const Visit& visit) {
  int x = static_cast<int>(std::floor(x0)), y = static_cast<int>(std::floor(y0));
  const int end_x = static_cast<int>(std::floor(x1)), end_y = static_cast<int>(std::floor(y1));
  const double dx = x1 - x0, dy = y1 - y0;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const int step_x = dx > 0 ? 1 : -1, step_y = dy > 0 ? 1 : -1;
  // the share of the way at which the next column, the next row begins
  const double span_x = dx != 0 ? std::abs(1.0 / dx) : kNever, span_y = dy != 0 ? std::abs(1.0 / dy) : kNever;
  double next_x = dx != 0 ? (x + (dx > 0) - x0) / dx : kNever, next_y = dy != 0 ? (y + (dy > 0) - y0) / dy : kNever;
  // counted, so that rounding can neither miss the end nor run past it
  int left_x = std::abs(end_x - x), left_y = std::abs(end_y - y);
  visit(x, y);
  while (left_x + left_y > 0) {
    if (left_y == 0 || (left_x > 0 && next_x < next_y))
      x += step_x, next_x += span_x, --left_x;
    else
      y += step_y, next_y += span_y, --left_y;
    visit(x, y);
  }
}

}  // namespace field_fusion::core
