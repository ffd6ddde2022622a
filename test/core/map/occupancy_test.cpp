#include "field_fusion/core/map/occupancy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "field_fusion/core/map/local_map.h"
#include "room.h"

namespace field_fusion::core {
namespace {

/// What a whole redraw gives, cell by cell.
void expectDrawn(const Occupancy& picture, const TileMap& map) {
  const int x0 = static_cast<int>(std::lround(picture.x / picture.resolution));
  const int y0 = static_cast<int>(std::lround(picture.y / picture.resolution));
  ASSERT_EQ(picture.cells.size(), static_cast<std::size_t>(picture.width) * picture.height);
  for (int i = 0; i < picture.width * picture.height; ++i) {
    const Cell cell = map.cell(x0 + i % picture.width, y0 + i / picture.width);
    const int expected = cell.visits == 0 ? -1 : map.isOccupied(cell) ? 100 : 0;
    ASSERT_EQ(picture.cells[i], expected) << i;
  }
  map.forEach([&](TilePlace p, const Tile&, const NearestField*) {
    EXPECT_TRUE(p.x * kTileSide >= x0 && (p.x + 1) * kTileSide <= x0 + picture.width) << p.x;
    EXPECT_TRUE(p.y * kTileSide >= y0 && (p.y + 1) * kTileSide <= y0 + picture.height) << p.y;
  });
}

TEST(OccupancyDrawer, IsAlwaysWhatAWholeRedrawWouldBe) {
  OccupancyDrawer drawer(0.05);
  EXPECT_TRUE(drawer.update(TileMap()).cells.empty()) << "of an empty map";
  ScanInsertion insertion;
  TileMap a, b;
  std::uint64_t revision = 0;
  for (int k = 0; k < 6; ++k) {
    insertion.insert(test::roomScan({0.3 * k, -1.0, 0.2 * k}), {0.3 * k, -1.0, 0.2 * k}, 0.05, ++revision, a);
    expectDrawn(drawer.update(a), a);
  }
  b = a;  // another particle: the past in common, then a wrong turn
  insertion.insert(test::roomScan({}), {40.0, -25.0, 1.0}, 0.05, ++revision, b);
  insertion.insert(test::roomScan({}), {0.1, 0.0, 0.0}, 0.05, ++revision, a);
  expectDrawn(drawer.update(b), b);
  expectDrawn(drawer.update(a), a);  // what only the other has is unknown again
}

TEST(OccupancyDrawer, CostsWhatHasChangedNotWhatIsThere) {
  OccupancyDrawer drawer(0.05);
  ScanInsertion insertion;
  TileMap map;
  for (int k = 0; k < 50; ++k) insertion.insert(test::roomScan({}), {20.0 * k, 0.0, 0.0}, 0.05, k + 1, map);
  drawer.update(map);  // a kilometre of rooms
  const std::size_t all = drawer.drawn();
  drawer.update(map);
  EXPECT_EQ(drawer.drawn(), 0u);
  insertion.insert(test::roomScan({}), {0.0, 0.0, 0.0}, 0.05, 99, map);
  drawer.update(map);
  EXPECT_GT(drawer.drawn(), 0u);
  EXPECT_LE(drawer.drawn(), all / 40);
}

TEST(Occupancy, AboutAPlaceIsHitsByVisits) {
  TileMap map;
  Tile& tile = map.writable({0, 0});
  tile.hit(3, 5, 0.f, 0.f);
  for (int i = 0; i < 3; ++i) tile.visit(3, 5);
  map.writable({-1, 0}).visit(-1, 5);
  const Occupancy about = occupancyAbout(map, 0.1, 0.0, 0.5, 1.0);  // cells [-5, 5) x [0, 10)
  ASSERT_EQ(about.width, 10);
  EXPECT_DOUBLE_EQ(about.x, -0.5);
  EXPECT_DOUBLE_EQ(about.y, 0.0);
  EXPECT_EQ(about.cells[5 * 10 + 3 + 5], 25);
  EXPECT_EQ(about.cells[5 * 10 - 1 + 5], 0);
  EXPECT_EQ(about.cells[0], kUnknownCell);
}

TEST(TileMapOf, IsDrawnAsItCame) {
  Occupancy picture{0.05, -1.0, 0.5, 40, 3, std::vector<std::int8_t>(120, kUnknownCell)};
  picture.cells[0] = kWallCell, picture.cells[41] = kFreeCell, picture.cells[119] = kWallCell;
  const TileMap map = tileMapOf(picture, 0.05, 0.25f);
  const Occupancy about = occupancyAbout(map, 0.05, 0.0, 0.575, 2.0);
  EXPECT_TRUE(map.isOccupied(map.cell(-20, 10)));
  EXPECT_FALSE(map.isOccupied(map.cell(-19, 11)));
  EXPECT_TRUE(map.isOccupied(map.cell(19, 12)));
  EXPECT_TRUE(map.tile({0, 0})->isOccupied(19, 12)) << "the matcher sees it";
  EXPECT_EQ(std::count(about.cells.begin(), about.cells.end(), kUnknownCell), 40 * 40 - 3);
  EXPECT_THROW(tileMapOf(picture, 0.1, 0.25f), std::runtime_error) << "another resolution";
  picture.x = -1.02;
  EXPECT_THROW(tileMapOf(picture, 0.05, 0.25f), std::runtime_error) << "its cells lie across those of the map";
}

TEST(LocalMap, HasTheLastWayAlone) {
  LocalMap local;
  PathNode::Pointer path;
  for (int k = 0; k <= 30; ++k) {  // a wall that comes 2 m ahead of the robot, wherever it is
    SlamScan scan;
    scan.hits.push_back({{2.f, 0.02f}});
    path = new PathNode({k, {0.5 * k, 0.02, 0.0}}, path);
    local.add(scan, path.get(), 3.0);
  }
  const Occupancy map = local.draw(path.get(), 0.1, 20.0);
  EXPECT_NEAR(map.x + 0.5 * 20.0, 15.0, 0.1) << "about the robot";
  EXPECT_EQ(std::count_if(map.cells.begin(), map.cells.end(), [](int c) { return c == 100; }), 1)
      << "beams end at 14 to 17 m; those of later scans go through all but the last";
  const auto at = [&](double x) { return map.cells[static_cast<std::size_t>(100 * 200 + std::floor((x - map.x) / 0.1))]; };
  EXPECT_EQ(at(17.05), 100);
  EXPECT_EQ(at(11.0), kUnknownCell) << "seen longer ago";
  local.clear();
  const Occupancy none = local.draw(nullptr, 0.1, 1.0);
  EXPECT_EQ(std::count(none.cells.begin(), none.cells.end(), kUnknownCell), 100);
}

}  // namespace
}  // namespace field_fusion::core
