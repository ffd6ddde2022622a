#include "field_fusion/core/cloud/cell_grid.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

constexpr int kDigitBits = 11;  // 2048 counters stay in the first cache level
constexpr std::uint32_t kDigits = 1u << kDigitBits;

/// Places are counted from 2^31 cells below zero: positive, so that a plain conversion rounds down.
constexpr double kOrigin = 2147483648.0;

/// Neighbours are so many cells away; as much room below the lowest cell keeps their places positive.
constexpr std::uint32_t kReach = 2;

/// Keys ascend by x, then y; the key of a neighbour is the cell's plus that of the offset, modulo 2^64.
std::uint64_t columnKey(std::int64_t x, std::int64_t y) { return (static_cast<std::uint64_t>(x) << 32) + y; }

constexpr std::size_t kColumns = 25;

/// Columns within reach, near ones first: what is looked for is mostly found there.
std::array<std::uint64_t, kColumns> columnOffsets() {
  constexpr int kFar = kReach;
  std::array<std::uint64_t, kColumns> out;
  std::size_t n = 0;
  for (int distance2 = 0; distance2 <= 2 * kFar * kFar; ++distance2)
    for (int x = -kFar; x <= kFar; ++x)
      for (int y = -kFar; y <= kFar; ++y)
        if (x * x + y * y == distance2) out[n++] = columnKey(x, y);
  return out;
}

}  // namespace

void CellGrid::build(const Cloud& cloud, double side) {
  if (!(side >= kSmallestCell))
    throw std::invalid_argument("cell side " + std::to_string(side) + " m is below the smallest, 0.005 m");
  place(cloud, side);
  sort();
  collect(cloud);
  runs_.clear();
  run_start_.assign(1, 0);
}

void CellGrid::place(const Cloud& cloud, double side) {
  const double scale = 1.0 / side;
  entries_.clear();
  lowest_.fill(0xffffffff);
  highest_.fill(0);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud[i];
    if (!usable(p)) continue;
    Entry entry{{}, i};
    const std::array<double, 3> at{double{p.x} * scale, double{p.y} * scale, double{p.z} * scale};
    for (int k = 0; k < 3; ++k) {
      entry.place[k] = static_cast<std::uint32_t>(static_cast<std::int64_t>(at[k] + kOrigin));
      lowest_[k] = std::min(lowest_[k], entry.place[k]);
      highest_[k] = std::max(highest_[k], entry.place[k]);
    }
    entries_.push_back(entry);
  }
}

// Stable radix sort from the least digit to the greatest; an axis costs only the digits it spans.
void CellGrid::sort() {
  sorted_.resize(entries_.size());
  if (entries_.empty()) return;
  for (const int axis : {2, 1, 0})
    for (std::uint64_t shift = 0, span = highest_[axis] - lowest_[axis]; span >> shift > 0;
         shift += kDigitBits)
      sortByDigit(axis, static_cast<int>(shift));
}

void CellGrid::sortByDigit(int axis, int shift) {
  std::array<std::uint32_t, kDigits> start{};
  const std::uint32_t lowest = lowest_[axis];
  const auto digit = [=](const Entry& e) { return (e.place[axis] - lowest) >> shift & (kDigits - 1); };
  for (const Entry& e : entries_) ++start[digit(e)];
  std::exclusive_scan(start.begin(), start.end(), start.begin(), 0u);
  for (const Entry& e : entries_) sorted_[start[digit(e)]++] = e;
  entries_.swap(sorted_);
}

void CellGrid::collect(const Cloud& cloud) {
  const std::size_t n = entries_.size();
  xs_.resize(n), ys_.resize(n), zs_.resize(n), index_.resize(n);
  cells_.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const Entry& e = entries_[i];
    const Point& p = cloud[e.index];
    xs_[i] = p.x, ys_[i] = p.y, zs_[i] = p.z, index_[i] = e.index;
    const std::uint64_t column =
        columnKey(e.place[0] - lowest_[0] + kReach, e.place[1] - lowest_[1] + kReach);
    const std::uint32_t z = e.place[2] - lowest_[2] + kReach;
    if (cells_.empty() || cells_.back().column != column || cells_.back().z != z)
      cells_.push_back({column, z, {i, 0}});
    ++cells_.back().points.count;
  }
}

// Cells ascend, and so do the cells that lie at one offset from them: one pointer for each offset sweeps
// forward over the list, and no search is needed.
void CellGrid::link() {
  static const auto offsets = columnOffsets();
  std::array<std::uint32_t, kColumns> sweep{};
  const auto count = static_cast<std::uint32_t>(cells_.size());
  runs_.clear();
  run_start_.assign(1, 0);
  for (const Cell& cell : cells_) {
    for (std::size_t k = 0; k < kColumns; ++k) {
      const std::uint64_t column = cell.column + offsets[k];
      const std::uint32_t low = cell.z - kReach, high = cell.z + kReach;
      std::uint32_t& first = sweep[k];
      while (first < count &&
             (cells_[first].column < column || (cells_[first].column == column && cells_[first].z < low)))
        ++first;
      std::uint32_t last = first;
      while (last < count && cells_[last].column == column && cells_[last].z <= high) ++last;
      if (last > first) runs_.push_back({first, last});
    }
    run_start_.push_back(static_cast<std::uint32_t>(runs_.size()));
  }
}

}  // namespace field_fusion::core
