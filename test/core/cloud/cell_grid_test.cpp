#include "field_fusion/core/cloud/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

std::array<double, 3> cellOf(const Point& p, double side) {
  return {std::floor(p.x / side), std::floor(p.y / side), std::floor(p.z / side)};
}

/// Places of the points in the cells that `link` found for the cell of sorted point `i`.
std::set<std::uint32_t> linkedTo(const CellGrid& grid, std::size_t cell) {
  std::set<std::uint32_t> out;
  for (const auto run : grid.neighbours(cell))
    for (std::uint32_t other = run.first; other < run.last; ++other)
      for (std::uint32_t k = 0; k < grid.points(other).count; ++k)
        out.insert(grid.index()[grid.points(other).first + k]);
  return out;
}

TEST(CellGrid, HoldsEachUsablePointOnceInItsCell) {
  const Cloud cloud = test::fillBox(2000, {-5.f, -5.f, -2.f}, {5.f, 5.f, 2.f});
  CellGrid grid;
  grid.build(cloud, 0.5);
  std::set<std::array<double, 3>> cells;
  std::set<std::uint32_t> seen;
  for (std::size_t cell = 0; cell < grid.cellCount(); ++cell) {
    const auto [first, count] = grid.points(cell);
    EXPECT_TRUE(cells.insert(cellOf(cloud[grid.index()[first]], 0.5)).second);
    for (std::uint32_t i = first; i < first + count; ++i) {
      EXPECT_EQ(cellOf(cloud[grid.index()[i]], 0.5), cellOf(cloud[grid.index()[first]], 0.5));
      EXPECT_EQ(grid.xs()[i], cloud[grid.index()[i]].x);
      seen.insert(grid.index()[i]);
    }
  }
  EXPECT_EQ(seen.size(), cloud.size());
}

TEST(CellGrid, NeighboursAreTheCellsAtMostTwoAwayWhenComparedOneByOne) {
  const Cloud cloud = test::fillBox(600, {-3.f, -3.f, -1.f}, {3.f, 3.f, 1.f});
  CellGrid grid;
  grid.build(cloud, 0.5);
  grid.link();
  for (std::size_t cell = 0; cell < grid.cellCount(); ++cell) {
    const auto own = cellOf(cloud[grid.index()[grid.points(cell).first]], 0.5);
    std::set<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      const auto other = cellOf(cloud[i], 0.5);
      if (std::abs(other[0] - own[0]) <= 2 && std::abs(other[1] - own[1]) <= 2 &&
          std::abs(other[2] - own[2]) <= 2)
        expected.insert(i);
    }
    EXPECT_EQ(linkedTo(grid, cell), expected);
  }
}

TEST(CellGrid, CellsAreSortedAndKeepTheOrderOfTheCloudWithin) {
  const Cloud cloud = test::fillBox(3000, {-400.f, -400.f, -50.f}, {400.f, 400.f, 50.f});
  CellGrid grid;
  grid.build(test::join({cloud, cloud}), 0.1);
  std::array<double, 3> last{-1e9, 0, 0};
  for (std::size_t cell = 0; cell < grid.cellCount(); ++cell) {
    const auto [first, count] = grid.points(cell);
    const auto here = cellOf(cloud[grid.index()[first] % cloud.size()], 0.1);
    EXPECT_LT(last, here);
    last = here;
    EXPECT_TRUE(std::is_sorted(grid.index() + first, grid.index() + first + count));
  }
}

TEST(CellGrid, TenThousandKilometresApartNeedNoMoreThanTwoCells) {
  CellGrid grid;
  grid.build({at(-1e7f, -1e7f, -1e7f), at(1e7f, 1e7f, 1e7f)}, kSmallestCell);
  grid.link();
  ASSERT_EQ(grid.cellCount(), 2u);
  EXPECT_EQ(linkedTo(grid, 0), std::set<std::uint32_t>{0});
  EXPECT_EQ(linkedTo(grid, 1), std::set<std::uint32_t>{1});
}

TEST(CellGrid, LeavesOutWhatHasNoPlace) {
  CellGrid grid;
  grid.build({at(kNaN, 0.f), at(0.f, INFINITY), at(0.f, 0.f, -INFINITY), at(1.1e7f, 0.f), at(3e38f, 0.f)},
             0.1);
  EXPECT_EQ(grid.pointCount(), 0u);
  EXPECT_EQ(grid.cellCount(), 0u);
}

TEST(CellGrid, RefusesASideThatCouldOverflow) {
  CellGrid grid;
  EXPECT_THROW(grid.build({}, 0.0), std::invalid_argument);
  EXPECT_THROW(grid.build({}, -1.0), std::invalid_argument);
  EXPECT_THROW(grid.build({}, kNaN), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
