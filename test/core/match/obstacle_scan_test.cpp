#include "field_fusion/core/match/obstacle_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace field_fusion::core {
namespace {

constexpr float kFree = std::numeric_limits<float>::infinity();

Point at(double range, double azimuth_degrees, float z = 0.f) {
  Point out;
  out.x = static_cast<float>(range * std::cos(radians(azimuth_degrees)));
  out.y = static_cast<float>(range * std::sin(radians(azimuth_degrees)));
  out.z = z;
  return out;
}

ObstacleScanParams sector(double from, double to, double step, double point_radius = 0.001) {
  ObstacleScanParams out;
  out.azimuth_min = from, out.azimuth_max = to, out.azimuth_step = step, out.point_radius = point_radius;
  return out;
}

std::vector<float> ranges(const ObstacleScanParams& params, const Cloud& points, bool looked = true) {
  return ObstacleScanner(params).run(points, looked).ranges;
}

/// Places of the rays that are not free.
std::vector<std::size_t> marked(const std::vector<float>& ranges) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    if (ranges[i] != kFree) out.push_back(i);
  return out;
}

using Places = std::vector<std::size_t>;

TEST(ObstacleScan, RaysRunFromOneEndToTheOtherInEvenSteps) {
  ObstacleScanner scanner(sector(-60, 60, 0.7));  // 171.4 steps: 172
  const auto& scan = scanner.run({}, true);
  EXPECT_EQ(scan.ranges.size(), 173u);
  EXPECT_NEAR(scan.azimuth + scan.step * 172, radians(60), 1e-12);
  EXPECT_TRUE(marked(scan.ranges).empty());
}

TEST(ObstacleScan, FullCircleHasNoRayTwice) {
  EXPECT_EQ(ranges(sector(-180, 180, 0.5), {}).size(), 720u);
  EXPECT_EQ(ranges(sector(0, 360, 45), {}).size(), 8u);
  EXPECT_EQ(ranges(sector(150, -150, 10), {}).size(), 7u);  // across 180
}

TEST(ObstacleScan, NearestOfARayCounts) {
  const auto out = ranges(sector(-10, 10, 10), {at(7, 1), at(3, -1), at(5, 0)});
  EXPECT_EQ(marked(out), Places{1});
  EXPECT_FLOAT_EQ(out[1], 3.f);
}

TEST(ObstacleScan, HeightHasNoPartInTheRange) {
  EXPECT_FLOAT_EQ(ranges(sector(-10, 10, 10), {at(3, 0, 4.f)})[1], 3.f);
}

// Between the rays at 0 and 10 deg, wherever the point stands, one of the two has it.
TEST(ObstacleScan, NarrowBodyBetweenRaysIsNeverLost) {
  for (double azimuth = 0.0; azimuth <= 10.0; azimuth += 0.25) {
    const auto places = marked(ranges(sector(-90, 90, 10), {at(20, azimuth)}));
    ASSERT_FALSE(places.empty()) << azimuth;
    for (const auto place : places)
      EXPECT_LE(std::abs(10.0 * double(place) - 90.0 - azimuth), 5.01) << azimuth;
  }
}

TEST(ObstacleScan, RaysAreAsWideAsTheEndsOfTheSectorSay) {
  const auto params = sector(-10, 10, 1);
  EXPECT_EQ(marked(ranges(params, {at(20, 10.4)})), Places{20});
  EXPECT_EQ(marked(ranges(params, {at(20, -10.4)})), Places{0});
  EXPECT_TRUE(marked(ranges(params, {at(20, 10.6), at(20, 180), at(20, -90)})).empty());
}

TEST(ObstacleScan, CircleClosesAcrossItsEnds) {
  EXPECT_EQ(marked(ranges(sector(-180, 180, 1), {at(20, 179.8), at(20, -179.8)})), Places{0});
  EXPECT_EQ(marked(ranges(sector(-360, 0, 1), {at(20, 90)})), Places{90});
  EXPECT_EQ(marked(ranges(sector(0, 360, 1), {at(20, -90)})), Places{270});
}

// A disc of 0.1 m radius 2 m away is seen within 2.86 deg to either side.
TEST(ObstacleScan, PointReachesToItsSides) {
  EXPECT_EQ(marked(ranges(sector(-90, 90, 1, 0.1), {at(2, 0)})), (Places{87, 88, 89, 90, 91, 92, 93}));
}

TEST(ObstacleScan, WallWithoutGapsWhereItsPointsAreCloserThanTwoRadii) {
  Cloud wall;
  for (float y = -3.f; y <= 3.f; y += 0.09f) {
    wall.emplace_back();
    wall.back().x = 2.f, wall.back().y = y;
  }
  const auto out = ranges(sector(-45, 45, 0.25, 0.05), wall);
  EXPECT_EQ(marked(out).size(), out.size());
}

TEST(ObstacleScan, NearerThanTheShortestRangeIsPutThere) {
  auto params = sector(-10, 10, 10);
  params.range_min = 1.0;
  EXPECT_EQ(ranges(params, {at(0.5, 0)})[1], 1.f);
  EXPECT_EQ(ranges(params, {at(0.0, 0)})[1], 1.f);
}

TEST(ObstacleScan, FromTheLongestRangeOnTheRayIsFree) {
  auto params = sector(-10, 10, 10);
  params.range_max = 30.0;
  EXPECT_EQ(ranges(params, {at(30.0, 0)})[1], kFree);
  EXPECT_FLOAT_EQ(ranges(params, {at(29.99, 0)})[1], 29.99f);
}

TEST(ObstacleScan, UnusablePointsAreNoObstacle) {
  Cloud cloud(3);
  cloud[0].x = NAN, cloud[1].y = INFINITY, cloud[2].x = -INFINITY;
  EXPECT_TRUE(marked(ranges(sector(-180, 180, 1), cloud)).empty());
}

TEST(ObstacleScan, WhatWasNotLookedAtIsNotFree) {
  const auto out = ranges(sector(-10, 10, 10), {at(5, 0)}, false);
  EXPECT_TRUE(std::isnan(out[0]) && std::isnan(out[2]));
  EXPECT_FLOAT_EQ(out[1], 5.f);
}

TEST(ObstacleScan, RayThatMeetsWhatIsUnclearIsNotFree) {
  ObstacleScanner scanner(sector(-20, 20, 10));
  const auto& out =
      scanner.run({at(5, 0), at(5, 10)}, true, {at(3, 0), at(7, 10), at(7, -10), at(99, 20)}).ranges;
  EXPECT_EQ(out[0], kFree);
  EXPECT_TRUE(std::isnan(out[1]));
  EXPECT_FLOAT_EQ(out[2], 5.f);  // an obstacle counts, whatever else is there
  EXPECT_FLOAT_EQ(out[3], 5.f);
  EXPECT_EQ(out[4], kFree);  // beyond range_max
}

TEST(ObstacleScan, AgreesWithEveryRayAgainstEveryPoint) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> range(0.3, 40.0), azimuth(-180.0, 180.0);
  Cloud cloud;
  for (int i = 0; i < 300; ++i) cloud.push_back(at(range(random), azimuth(random)));
  ObstacleScanner scanner(sector(-200, 30, 0.8, 0.2));
  const auto& scan = scanner.run(cloud, true);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    float expected = kFree;
    for (const auto& p : cloud) {
      const double r = std::hypot(p.x, p.y);
      const double away =
          std::abs(angleDifference(std::atan2(p.y, p.x), scan.azimuth + double(i) * scan.step));
      if (r < 30.0 && away <= 0.5 * scan.step + std::atan(0.2 / r)) expected = std::min(expected, float(r));
    }
    EXPECT_EQ(scan.ranges[i], expected) << i;
  }
}

TEST(ObstacleScan, OrderOfThePointsHasNoSay) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> range(0.3, 40.0), azimuth(-180.0, 180.0);
  Cloud cloud;
  for (int i = 0; i < 200; ++i) cloud.push_back(at(range(random), azimuth(random)));
  const auto before = ranges(ObstacleScanParams(), cloud);
  std::shuffle(cloud.begin(), cloud.end(), random);
  EXPECT_EQ(ranges(ObstacleScanParams(), cloud), before);
}

TEST(ObstacleScan, FaultyParametersAreNamed) {
  auto params = sector(10, 10, 1);
  params.range_min = 80.0;
  try {
    ObstacleScanner scanner(params);
    FAIL() << "taken";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("azimuth_min"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("range_min"), std::string::npos);
  }
}

}  // namespace
}  // namespace field_fusion::core
