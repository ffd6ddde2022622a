#pragma once
// Points of a cloud sorted into cubic cells. Only occupied cells are stored, so the memory depends on the
// number of points and never on how far apart they lie.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// [m] Coordinates beyond this are unusable: float32 resolves them no finer than a metre, and the
/// smallest cell keeps its place within 32 bits.
constexpr float kFarthest = 1e7f;

/// [m] Smallest cell side.
constexpr double kSmallestCell = 0.005;

/// False for NaN, infinity and coordinates beyond kFarthest.
inline bool usable(const Point& p) {
  return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}

/// A lattice of cells fixed at the origin. Keeps its buffers from cloud to cloud.
class CellGrid {
 public:
  /// Cells first ... last - 1.
  struct Run {
    std::uint32_t first, last;
  };
  struct Runs {
    const Run *first, *last;
    const Run* begin() const { return first; }
    const Run* end() const { return last; }
  };

  /// Sorts the usable points of `cloud` into cells of `side` [m] >= kSmallestCell; throws
  /// std::invalid_argument for another side. Cells ascend by x, y, z; points of one cell by their place
  /// in the cloud.
  void build(const Cloud& cloud, double side);

  /// Finds, for each cell, the occupied cells at most two cells away along each axis, itself included;
  /// the cell's own column comes first, the remote ones last.
  void link();

  std::size_t cellCount() const { return cells_.size(); }
  std::size_t pointCount() const { return index_.size(); }

  /// Points of `cell` are places first ... first + count - 1 of xs, ys, zs and index.
  IndexRange points(std::size_t cell) const { return cells_[cell].points; }
  Runs neighbours(std::size_t cell) const {
    return {runs_.data() + run_start_[cell], runs_.data() + run_start_[cell + 1]};
  }

  const float* xs() const { return xs_.data(); }
  const float* ys() const { return ys_.data(); }
  const float* zs() const { return zs_.data(); }
  /// Place in the cloud of each sorted point.
  const std::uint32_t* index() const { return index_.data(); }

 private:
  struct Entry {
    std::array<std::uint32_t, 3> place;
    std::uint32_t index;
  };
  struct Cell {
    std::uint64_t column;  ///< x place in the upper half, y place in the lower
    std::uint32_t z;
    IndexRange points;
  };

  void place(const Cloud& cloud, double side);
  void sort();
  void sortByDigit(int axis, int shift);
  void collect(const Cloud& cloud);

  std::vector<Entry> entries_, sorted_;
  std::array<std::uint32_t, 3> lowest_{}, highest_{};
  std::vector<Cell> cells_;
  std::vector<float> xs_, ys_, zs_;
  std::vector<std::uint32_t> index_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> run_start_;
};

}  // namespace field_fusion::core
