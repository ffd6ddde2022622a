#include "field_fusion/core/map/map_fusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

Occupancy one(std::int8_t cell, double x = 0.0, double resolution = 0.05) {
  return {resolution, x, 0.0, 1, 1, {cell}};
}

std::int8_t at(const MapFusion& fusion, double x) { return fusion.about(x, 0.0, 0.05).cells.at(0); }

enum Said { kUnknown, kVacant, kOccupied };
Said said(std::int8_t cell) { return cell < 0 ? kUnknown : cell >= 50 ? kOccupied : kVacant; }

struct Entry {
  std::int8_t a, b;
  Said fused;
};
class Table2 : public testing::TestWithParam<Entry> {};

/// Entries of paper 004's Table 2 as this stage reads them: occupied if either is, vacant if one is and none
/// occupied.
TEST_P(Table2, Holds) {
  MapFusion fusion;
  fusion.addA(one(GetParam().a), Silence::kForgets);
  fusion.addB(one(GetParam().b), Silence::kKeeps);
  EXPECT_EQ(said(at(fusion, 0.0)), GetParam().fused);
}

INSTANTIATE_TEST_SUITE_P(MapFusion, Table2,
                         testing::Values(Entry{100, 100, kOccupied}, Entry{100, 0, kOccupied},
                                         Entry{100, -1, kOccupied}, Entry{0, 100, kOccupied},
                                         Entry{0, 0, kVacant}, Entry{0, -1, kVacant},
                                         Entry{-1, 100, kOccupied}, Entry{-1, 0, kVacant},
                                         Entry{-1, -1, kUnknown}, Entry{0, 55, kOccupied},
                                         Entry{49, 49, kVacant}));

TEST(FusedLogOdds, AreTheProductOfTheOdds) {
  // Eq. 5: 0.7 * 0.8 / (0.7 * 0.8 + 0.3 * 0.2)
  const auto odds = [](double p) { return static_cast<float>(std::log(p / (1 - p))); };
  EXPECT_NEAR(fusedLogOdds(odds(0.7), odds(0.8), 0.f, -9.f, 9.f), odds(0.56 / 0.62), 1e-5);
  EXPECT_NEAR(fusedLogOdds(odds(0.3), odds(0.2), 0.f, -9.f, 9.f), odds(0.06 / 0.62), 1e-5);
  EXPECT_EQ(fusedLogOdds(odds(0.7), odds(0.8), 0.f, -9.f, 1.f), 1.f) << "clamped";
  EXPECT_EQ(fusedLogOdds(odds(0.1), odds(0.6), 0.f, -9.f, 9.f), odds(0.6)) << "occupied stays as it was";
  EXPECT_TRUE(std::isnan(fusedLogOdds(kNaN, kNaN, 0.f, -9.f, 9.f)));
  EXPECT_EQ(fusedLogOdds(kNaN, 2.f, 0.f, -9.f, 9.f), 2.f);
}

TEST(MapFusion, TheSameMapAgainMakesNoCellSurer) {
  MapFusion fusion;
  fusion.addA(one(60), Silence::kForgets);
  fusion.addB(one(60), Silence::kKeeps);
  const std::int8_t once = at(fusion, 0.0);
  EXPECT_EQ(once, 69) << "0.36 / (0.36 + 0.16)";
  for (int i = 0; i < 50; ++i) fusion.addB(one(60), Silence::kKeeps), fusion.addA(one(60), Silence::kForgets);
  EXPECT_EQ(at(fusion, 0.0), once);
}

TEST(MapFusion, ALowBoxStaysHoweverOftenTheScannerSeesOverIt) {
  MapFusion fusion;
  fusion.addB(one(97), Silence::kKeeps);
  for (int i = 0; i < 200; ++i) fusion.addA(one(0), Silence::kForgets);
  EXPECT_GE(at(fusion, 0.0), 50);
  fusion.addB(one(-1), Silence::kKeeps);  // it leaves the camera's view
  EXPECT_GE(at(fusion, 0.0), 50);
  fusion.addB(one(30), Silence::kKeeps);  // it is taken away before the camera
  EXPECT_LT(at(fusion, 0.0), 50);
}

TEST(MapFusion, SilenceOfAWholeMapForgets) {
  MapFusion fusion;
  fusion.addA(one(100), Silence::kForgets);
  fusion.addA(one(-1), Silence::kForgets);
  EXPECT_EQ(at(fusion, 0.0), kUnknownCell);
}

TEST(MapFusion, GrowsInAllDirectionsAndKeepsWhatWasThere) {
  MapFusion fusion;
  fusion.addA(one(100), Silence::kForgets);
  fusion.addB({0.05, -10.0, -20.0, 2, 1, {0, 100}}, Silence::kKeeps);
  fusion.addB(one(0, 30.0), Silence::kKeeps);
  EXPECT_GE(at(fusion, 0.0), 50);
  EXPECT_LT(at(fusion, 30.0), 50);
  EXPECT_EQ(at(fusion, 1.0), kUnknownCell);
  const Occupancy& map = fusion.map();
  EXPECT_LE(map.x, -10.0);
  EXPECT_LE(map.y, -20.0);
  EXPECT_EQ(std::count_if(map.cells.begin(), map.cells.end(), [](std::int8_t c) { return c >= 50; }), 2);
  EXPECT_EQ(map.cells.size(), static_cast<std::size_t>(map.width) * map.height);
}

TEST(MapFusion, AWholeMapThatIsSmallerForgetsWhatLiesBeyondIt) {
  MapFusion fusion;
  fusion.addA({0.05, 0.0, 0.0, 3, 1, {100, 100, 100}}, Silence::kForgets);
  fusion.addB(one(100, 0.05), Silence::kKeeps);
  fusion.addA(one(0), Silence::kForgets);
  EXPECT_LT(at(fusion, 0.0), 50);
  EXPECT_GE(at(fusion, 0.05), 50) << "the other map knows it still";
  EXPECT_EQ(at(fusion, 0.1), kUnknownCell);
}

TEST(MapFusion, AMapFarAwayIsRefusedForTheLengthOfBoth) {
  MapFusionParams params;
  params.max_side = 100.0;
  MapFusion fusion(params);
  fusion.addA(one(100), Silence::kForgets);
  EXPECT_NO_THROW(fusion.addB(one(100, 90.0), Silence::kKeeps));
  EXPECT_THROW(fusion.addB(one(100, 110.0), Silence::kKeeps), std::runtime_error);
  EXPECT_GE(at(fusion, 90.0), 50);
  EXPECT_LE(fusion.map().width * fusion.map().resolution, 100.0);
}

TEST(MapFusion, OrderOfTheTwoHasNoSay) {
  MapFusion ab, ba;
  ab.addA(one(80), Silence::kForgets), ab.addB(one(30), Silence::kKeeps);
  ba.addB(one(30), Silence::kKeeps), ba.addA(one(80), Silence::kForgets);
  EXPECT_EQ(at(ab, 0.0), at(ba, 0.0));
}

TEST(MapFusion, CellsBetweenTheOthersGoToTheNearest) {
  MapFusion fusion;
  fusion.addA(one(100), Silence::kForgets);
  EXPECT_NEAR(fusion.shift(), 0.0, 1e-9);
  fusion.addB(one(100, 0.07), Silence::kKeeps);
  EXPECT_NEAR(fusion.shift(), 0.4, 1e-9);
  EXPECT_GE(at(fusion, 0.05), 50);
}

TEST(MapFusion, RefusesWhatDoesNotFitAndKeepsWhatItHas) {
  MapFusion fusion;
  fusion.addA(one(100), Silence::kForgets);
  const auto fault = [&](const Occupancy& map) {
    try {
      fusion.addB(map, Silence::kKeeps);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault(one(0, 0.0, 0.1)), "resolution differs: 0.1 m, the maps before had 0.05 m");
  EXPECT_EQ(fault({0.05, 0.0, 0.0, 2, 2, {0}}), "map damaged: 1 cells, not 2 x 2");
  EXPECT_EQ(fault(one(101)), "map damaged: a cell of 101, neither -1 nor 0 to 100");
  EXPECT_EQ(fault(one(0, kNaN)), "map too far: it is beyond all bounds");
  EXPECT_EQ(fault(one(0, 1e6)).rfind("map too far: with it", 0), 0u) << "a thousand kilometres away";
  EXPECT_EQ(fault(one(0, 0.0, 0.0)), "map damaged: cells of 0.0 m");
  EXPECT_EQ(fault({0.05, 0.0, 0.0, 0, 0, {}}), "") << "nothing is no fault";
  EXPECT_GE(at(fusion, 0.0), 50);
}

TEST(MapFusion, OfNothingIsEmpty) {
  MapFusion fusion;
  EXPECT_TRUE(fusion.map().cells.empty());
  EXPECT_EQ(at(fusion, 0.0), kUnknownCell);
  fusion.addA(one(100), Silence::kForgets);
  fusion.clear();
  EXPECT_TRUE(fusion.map().cells.empty());
}

TEST(MapFusion, NewParametersFuseAnew) {
  MapFusion fusion;
  fusion.addA(one(100), Silence::kForgets);
  EXPECT_EQ(at(fusion, 0.0), 97);
  MapFusionParams params;
  params.clamp_max = 0.9;
  fusion.setParams(params);
  EXPECT_EQ(at(fusion, 0.0), 90);
  params.occupied = 0.95;
  EXPECT_THROW(fusion.setParams(params), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
