#include "field_fusion/core/map/tile_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

#include "field_fusion/core/map/scan_insertion.h"

namespace field_fusion::core {
namespace {

TEST(Tile, CellsAreHitsByVisitsAndKeepTheMeanOfTheirHits) {
  Tile tile;
  EXPECT_TRUE(std::isnan(tile.at(3, 5).probability()));
  EXPECT_FALSE(tile.seen(3, 5));
  tile.hit(3, 5, 0.2f, -0.4f), tile.visit(3, 5), tile.hit(3, 5, 0.4f, 0.2f), tile.visit(3, 5);
  const Cell cell = tile.at(3, 5);
  EXPECT_FLOAT_EQ(cell.probability(), 0.5f);
  EXPECT_NEAR(cell.x / (2.f * Cell::kHalf), 0.3f, 1e-4f);
  EXPECT_NEAR(cell.y / (2.f * Cell::kHalf), -0.1f, 1e-4f);
  EXPECT_TRUE(tile.seen(3, 5));
}

TEST(Tile, CellsKeepTheirProbabilityWhenTheirCountsAreFull) {
  Tile tile;
  for (int i = 0; i < 300000; ++i) i % 4 == 0 ? tile.hit(-1, 31, 0.5f, -0.5f) : tile.visit(-1, 31);
  const Cell cell = tile.at(-1, 31);
  EXPECT_NEAR(cell.probability(), 0.25f, 1e-3f);
  EXPECT_EQ(cell.x, 32767);
  EXPECT_EQ(cell.y, -32767);
}

TEST(Tile, WhatWasNeverHitCountsUpTo255) {
  Tile tile;
  for (int i = 0; i < 1000; ++i) tile.visit(0, 0);
  EXPECT_EQ(tile.at(0, 0).visits, 255);
  tile.hit(0, 0, 0.f, 0.f);
  EXPECT_EQ(tile.at(0, 0).visits, 256);
  EXPECT_EQ(tile.at(0, 0).hits, 1);
}

/// In any order of hits, whatever cells of the tile have been hit before.
TEST(Tile, EveryCellHasItsOwnHits) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> place(-32, -1);
  Tile tile;
  std::map<std::pair<int, int>, std::pair<int, int>> plain;  // hits, visits
  for (int step = 0; step < 3000; ++step) {
    const int x = place(random), y = place(random);
    auto& [hits, visits] = plain[{x, y}];
    ++visits;
    if (step % 3 == 0)
      ++hits, tile.hit(x, y, 0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y));
    else
      tile.visit(x, y);
  }
  for (const auto& [at, counts] : plain) {
    const Cell cell = tile.at(at.first, at.second);
    EXPECT_EQ(cell.hits, counts.first);
    EXPECT_EQ(cell.visits, counts.second);
    EXPECT_EQ(tile.wasHit(at.first, at.second), counts.first > 0);
    if (counts.first == 0) continue;
    EXPECT_NEAR(cell.x / (2.f * Cell::kHalf), 0.01f * static_cast<float>(at.first), 1e-4f);
    EXPECT_NEAR(cell.y / (2.f * Cell::kHalf), 0.01f * static_cast<float>(at.second), 1e-4f);
  }
}

/// What a copy of every cell would hold.
using Plain = std::map<std::pair<int, int>, int>;

void expectEqual(const TileMap& map, const Plain& plain) {
  std::size_t known = 0;
  map.forEach([&](TilePlace, const Tile& tile, const NearestField*) {
    for (int i = 0; i < kTileCells; ++i) known += tile.seen(i % kTileSide, i / kTileSide);
  });
  EXPECT_EQ(known, plain.size());
  for (const auto& [at, visits] : plain) EXPECT_EQ(map.cell(at.first, at.second).visits, visits);
}

TEST(TileMap, CopiesBehaveAsDeepCopies) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-700, 700), pick(0, 4);
  std::vector<TileMap> maps(5);
  std::vector<Plain> plains(5);
  for (int step = 0; step < 4000; ++step) {
    const auto i = static_cast<std::size_t>(pick(random)), j = static_cast<std::size_t>(pick(random));
    if (step % 50 == 0) {
      maps[i] = maps[j], plains[i] = plains[j];
      continue;
    }
    const int x = place(random), y = place(random);
    maps[i].writable({x >> kTileBits, y >> kTileBits}).visit(x, y);
    ++plains[i][{x, y}];
  }
  for (std::size_t i = 0; i < maps.size(); ++i) expectEqual(maps[i], plains[i]);
}

TEST(TileMap, SharesWhatACopyDoesNotChange) {
  TileMap a;
  a.writable({0, 0}), a.writable({1, 0});
  TileMap b = a;
  EXPECT_EQ(a.tile({0, 0}), b.tile({0, 0}));
  const Tile* before = a.tile({1, 0});
  b.writable({1, 0});
  EXPECT_EQ(a.tile({1, 0}), before);
  EXPECT_NE(b.tile({1, 0}), before);
  EXPECT_EQ(a.tile({0, 0}), b.tile({0, 0}));
  b = TileMap();
  EXPECT_EQ(&a.writable({1, 0}), before) << "alone again, a map writes in place";
}

TEST(TileMap, GrowsPastAKilometreWithoutMovingTiles) {
  TileMap map;
  const Tile* first = &map.writable({0, 0});
  map.writable({700, -650}), map.writable({-700, 20});  // 1.1 km at 0.05 m
  EXPECT_EQ(map.tile({0, 0}), first);
  EXPECT_TRUE(map.tile({700, -650}));
  EXPECT_FALSE(map.tile({5000, 5000}));
  EXPECT_THROW(map.writable({1 << 20, 0}), std::out_of_range);
}

TileMap randomWalls(std::mt19937& random, int count) {
  std::uniform_int_distribution<int> place(-80, 80);
  TileMap map;
  for (int i = 0; i < count; ++i) {
    const int x = place(random), y = place(random);
    Tile& tile = map.writable({x >> kTileBits, y >> kTileBits});
    tile.hit(x, y, 0.25f, -0.25f), tile.setOccupied(x, y, true);
  }
  return map;
}

/// [cells^2] from the middle of (x, y) to the middle of the nearest wall; -1 beyond reach.
int bruteDistance(const TileMap& map, int x, int y) {
  int least = std::numeric_limits<int>::max();
  for (int v = -NearestField::kReach; v <= NearestField::kReach; ++v)
    for (int u = -NearestField::kReach; u <= NearestField::kReach; ++u)
      if (map.cell(x + u, y + v).hits > 0) least = std::min(least, u * u + v * v);
  return least <= NearestField::kReach * NearestField::kReach ? least : -1;
}

TEST(NearestField, FindsWhatASearchOfAllCellsFinds) {
  std::mt19937 random(2);
  for (const int count : {0, 1, 40, 2000}) {
    TileMap map = randomWalls(random, count);
    for (int y = -100; y < 100; ++y)
      for (int x = -100; x < 100; ++x) {
        const Wall* found = map.field({x >> kTileBits, y >> kTileBits}).at(x, y);
        const int expected = bruteDistance(map, x, y);
        ASSERT_EQ(found != nullptr, expected >= 0) << x << " " << y;
        if (!found) continue;
        // hits lie at (0.25, -0.25) from the middle of their cells
        const float u = found->x - 0.25f - static_cast<float>(x & 31) - 0.5f, v = found->y + 0.25f - static_cast<float>(y & 31) - 0.5f;
        // and may be moved by a cell at most where some happen to make a line
        ASSERT_NEAR(std::hypot(u, v), std::sqrt(static_cast<float>(expected)), found->line() ? 1.f : 0.01f) << x << " " << y;
      }
  }
}

TEST(NearestField, KnowsTheNormalOfAStraightWall) {
  for (const double angle : {0.0, 30.0, 45.0, 90.0, 120.0, 170.0}) {
    const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
    SlamScan scan;
    scan.origin = Eigen::Vector2f(-2.f * s, 2.f * c);
    for (double t = -1.0; t <= 1.0; t += 0.01) scan.hits.push_back({Eigen::Vector2f(t * c, t * s)});
    TileMap map;
    ScanInsertion().insert(scan, {}, 0.05, 1, map);
    const Wall* found = map.field({0, 0}).at(0, 0);
    ASSERT_TRUE(found && found->line()) << angle;
    EXPECT_NEAR(std::abs(-s * found->nx + c * found->ny), 1.0, 0.01) << angle;
  }
}

/// Beams that scatter about a wall on the edge of two rows of cells: those that cross the nearer row leave it free, so that
/// the farther alone, with the long ranges, is occupied.
TEST(NearestField, HasAWallWhereItIsThoughHalfItsCellsCountAsFree) {
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0.f, 0.012f);
  TileMap map;
  ScanInsertion insertion;
  for (int k = 0; k < 60; ++k) {
    SlamScan scan;  // from 1 m before the wall at y = 0.5 m, along it
    scan.origin = Eigen::Vector2f(-3.f + 0.05f * static_cast<float>(k), -0.5f);
    for (float t = -3.f; t <= 3.f; t += 0.11f) {
      const Eigen::Vector2f beam = Eigen::Vector2f(t, 0.5f) - scan.origin;
      scan.hits.push_back({scan.origin + beam * (1.f + noise(random) / beam.norm())});
    }
    insertion.insert(scan, {}, 0.05, static_cast<std::uint64_t>(k + 1), map);
  }
  ASSERT_TRUE(map.tile({0, 0})->isOccupied(4, 10));  // beyond the edge
  const Wall* found = map.field({0, 0}).at(4, 10);
  ASSERT_TRUE(found && found->line());
  EXPECT_NEAR(found->y, 10.f, 0.1f);  // 5 mm; some 30 hits of 12 mm, seen at a slant, leave 2 mm
}

}  // namespace
}  // namespace field_fusion::core
