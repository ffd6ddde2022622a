#include "field_fusion/core/map/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/octomap_reference.h"

namespace field_fusion::core {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points somewhere(int count, double spread, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> place(0.f, static_cast<float>(spread));
  Points out;
  for (int i = 0; i < count; ++i) out.emplace_back(place(random), place(random), place(random));
  return out;
}

struct Setting {
  const char* name;
  double resolution, max_range, spread;
};

class VoxelMapAsOctoMap : public testing::TestWithParam<Setting> {};

TEST_P(VoxelMapAsOctoMap, HasTheVeryLogOddsOfItsInsertPointCloud) {
  VoxelMapParams params;
  params.resolution = GetParam().resolution, params.max_range = GetParam().max_range, params.window = 0.0;
  for (const int threads : {1, 3}) {
    params.threads = threads;
    VoxelMap map(params);
    auto tree = test::octreeLike(params);
    for (unsigned scan = 0; scan < 12; ++scan) {  // enough to meet the clamps
      const Points points = somewhere(120, GetParam().spread, scan / 4);
      const Eigen::Vector3f sensor = somewhere(1, 0.3 * GetParam().spread, 100 + scan)[0];
      map.insert(points, sensor);
      tree.insertPointCloud(test::octomapCloud(points), test::octomapPoint(sensor), params.max_range);
    }
    const auto compared = test::difference(map, tree);
    EXPECT_EQ(compared.different, 0u) << "of " << compared.voxels;
    EXPECT_GT(compared.voxels, 1000u);
  }
}

INSTANTIATE_TEST_SUITE_P(VoxelMap, VoxelMapAsOctoMap,
                         testing::Values(Setting{"room", 0.05, 5.0, 1.5}, Setting{"far", 0.1, 3.0, 6.0},
                                         Setting{"odd", 0.037, 2.0, 1.0}, Setting{"coarse", 0.5, 40.0, 15.0}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(VoxelMap, RaysThroughEdgesAndAlongAxesAreOctoMapsToo) {
  VoxelMapParams params;
  params.resolution = 0.1, params.window = 0.0;
  Points points;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) points.emplace_back(0.5f * x, 0.5f * y, 0.5f * z);
  for (const float at : {0.f, 0.05f, 0.1f}) {
    VoxelMap map(params);
    auto tree = test::octreeLike(params);
    const Eigen::Vector3f sensor(at, at, at);
    map.insert(points, sensor);
    tree.insertPointCloud(test::octomapCloud(points), test::octomapPoint(sensor), params.max_range);
    EXPECT_EQ(test::difference(map, tree).different, 0u) << at;
  }
}

TEST(VoxelMap, OneRayIsFreeUpToItsEnd) {
  VoxelMapParams params;
  params.resolution = 1.0, params.max_range = 100.0;
  VoxelMap map(params);
  const VoxelCounts counts = map.insert({{4.5f, 0.5f, 0.5f}}, {0.5f, 0.5f, 0.5f});
  EXPECT_EQ(counts.points, 1u);
  EXPECT_EQ(counts.free, 4u);
  EXPECT_EQ(counts.occupied, 1u);
  for (int x = 0; x < 4; ++x) EXPECT_FLOAT_EQ(map.logOdds({x, 0, 0}), std::log(0.4f / 0.6f)) << x;
  EXPECT_FLOAT_EQ(map.logOdds({4, 0, 0}), std::log(0.7f / 0.3f));
  for (const VoxelKey& unknown :
       {VoxelKey(5, 0, 0), VoxelKey(-1, 0, 0), VoxelKey(2, 1, 0), VoxelKey(999, 0, 0)})
    EXPECT_TRUE(std::isnan(map.logOdds(unknown)));
}

TEST(VoxelMap, OfFarPointsOnlyTheWayCounts) {
  VoxelMapParams params;
  params.resolution = 1.0, params.max_range = 3.0;
  VoxelMap map(params);
  const VoxelCounts counts = map.insert({{9.5f, 0.5f, 0.5f}}, {0.5f, 0.5f, 0.5f});
  EXPECT_EQ(counts.far, 1u);
  EXPECT_EQ(counts.occupied, 0u);
  EXPECT_EQ(counts.free, 3u);
}

TEST(VoxelMap, OrderOfPointsHasNoSay) {
  Points points = somewhere(2000, 1.0, 5);
  VoxelMap forth, back;
  forth.insert(points, {0.f, 0.f, 0.f});
  std::reverse(points.begin(), points.end());
  back.insert(points, {0.f, 0.f, 0.f});
  forth.store().forEach([&](const CubeKey& place, const VoxelCube& cube) {
    ASSERT_TRUE(back.store().find(place));
    EXPECT_EQ(cube.known, back.store().find(place)->known);
    EXPECT_EQ(cube.log_odds, back.store().find(place)->log_odds);
  });
  EXPECT_EQ(forth.store().size(), back.store().size());
}

TEST(VoxelMap, NothingAndNonsenseChangeNothing) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  VoxelMap map;
  EXPECT_EQ(map.insert(Points{}, {0.f, 0.f, 0.f}).points, 0u);
  const Points bad = {{kNaN, 0.f, 0.f}, {0.f, kInf, 0.f}, {0.f, 0.f, -kInf}};
  EXPECT_EQ(map.insert(bad, {0.f, 0.f, 0.f}).unusable, 3u);
  EXPECT_EQ(map.insert({{1.f, 0.f, 0.f}}, {kNaN, 0.f, 0.f}).unusable, 1u);
  EXPECT_EQ(map.insert({{1.f, 0.f, 0.f}}, {1e9f, 0.f, 0.f}).unusable, 1u);
  EXPECT_EQ(map.store().size(), 0u);
  EXPECT_TRUE(map.project().cells.empty());
}

TEST(VoxelMap, PointsAreCarriedIntoTheMap) {
  VoxelMapParams params;
  params.resolution = 1.0;
  VoxelMap map(params);
  Transform T_map_sensor = Transform::Identity();
  T_map_sensor.translation() << 10.5, 0.5, 0.5;
  T_map_sensor.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  Cloud cloud(1);
  cloud[0].x = 2.f;
  map.insert(cloud, T_map_sensor);
  EXPECT_GT(map.logOdds({10, 2, 0}), 0.f);
  EXPECT_LT(map.logOdds({10, 1, 0}), 0.f);
}

TEST(VoxelMap, WhatIsTakenAwayFadesWithinTheClamps) {
  VoxelMapParams params;
  VoxelMap map(params);
  const Eigen::Vector3f sensor(0.f, 0.f, 0.2f);
  for (int i = 0; i < 1000; ++i) map.insert({{1.02f, 0.02f, 0.22f}}, sensor);
  const VoxelKey voxel = *map.lattice().key({1.02f, 0.02f, 0.22f});
  EXPECT_TRUE(map.isOccupied(map.logOdds(voxel)));
  // log(0.97 / 0.03) = 3.48 falls by log(0.6 / 0.4) = 0.41 a look
  int looks = 0;
  for (; map.isOccupied(map.logOdds(voxel)); ++looks) map.insert({{2.02f, 0.02f, 0.24f}}, sensor);
  EXPECT_EQ(looks, 9);
}

TEST(VoxelMap, ProjectsTheHighestOfEachColumnBetweenTheHeights) {
  VoxelMapParams params;
  params.resolution = 0.1, params.min_height = 0.1, params.max_height = 0.5;
  VoxelMap map(params);
  map.set({0, 0, 0}, 3.f);   // floor
  map.set({0, 0, 1}, -1.f);  // the lowest that counts
  map.set({1, 0, 4}, 2.f);   // the highest
  map.set({1, 0, 2}, -1.f);
  map.set({2, 0, 5}, 2.f);  // passed below
  const Occupancy b = map.project();
  ASSERT_EQ(b.width, 8);
  EXPECT_EQ(b.x, 0.0);
  EXPECT_EQ(b.cells[0], 27) << "1 / (1 + e)";
  EXPECT_EQ(b.cells[1], 88) << "1 / (1 + 1 / e^2)";
  EXPECT_EQ(b.cells[2], kUnknownCell);
  const Occupancy about = map.projectAbout(0.1, 0.0, 0.4);
  EXPECT_EQ(about.width, 4);
  EXPECT_NEAR(about.x, -0.1, 1e-12);
  EXPECT_EQ(about.cells[2 * 4 + 1], 27);
  EXPECT_EQ(about.cells[2 * 4 + 2], 88);
}

TEST(VoxelMap, ForgetsWhatIsOutsideTheWindow) {
  VoxelMapParams params;
  params.resolution = 0.1, params.window = 4.0;
  VoxelMap map(params);
  map.set({0, 0, 0}, 1.f), map.set({19, 0, 0}, 1.f), map.set({40, 0, 0}, 1.f), map.set({0, -40, 0}, 1.f);
  EXPECT_EQ(map.keepAbout(0.0, 0.0), 2u);
  EXPECT_FALSE(std::isnan(map.logOdds({19, 0, 0})));
  EXPECT_TRUE(std::isnan(map.logOdds({40, 0, 0})));
  params.window = 0.0;
  map.setLive(params);
  EXPECT_EQ(map.keepAbout(1000.0, 0.0), 0u);
}

TEST(VoxelMap, RefusesParametersThatMakeNoMap) {
  VoxelMapParams params;
  params.hit = 1.0;
  EXPECT_THROW(VoxelMap{params}, std::invalid_argument);
  params = {};
  params.max_range = 60.0;
  EXPECT_THROW(VoxelMap{params}, std::invalid_argument) << "more than 1000 voxels";
  params = {};
  params.min_height = params.max_height;
  EXPECT_THROW(VoxelMap{params}, std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
