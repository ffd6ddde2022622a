#include "field_fusion/core/cloud/ground.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/clouds.h"
#include "support/relief.h"
#include "support/street.h"

namespace field_fusion::core {
namespace {

using test::at;

struct Parted {
  Ground result;
  Cloud ground, obstacles;
};

Parted part(GroundFinder& finder, const Cloud& cloud, double stamp = 0.0,
            const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ()) {
  Parted out;
  out.result = finder.run(cloud, stamp, out.ground, out.obstacles, up);
  return out;
}

Parted part(const Cloud& cloud, const GroundParams& params = {}) {
  GroundFinder finder(params);
  return part(finder, cloud);
}

/// Floor `depth` [m] below the sensor with a box of 200 points on it.
Cloud scene(float depth, float slope = 0.f) {
  return test::join(
      {test::floor(3000, -depth, slope, 0.02f), test::fillBox(200, {5, -1, -depth + 0.5f}, {6, 1, 0})});
}

TEST(Ground, FindsThePlaneAndKeepsWhatStandsOnIt) {
  const Parted parted = part(scene(1.7f));
  ASSERT_TRUE(parted.result.found());
  EXPECT_NEAR(parted.result.plane.offset, 1.7, 0.01);
  EXPECT_NEAR(parted.result.tilt, 0.0, 0.002);
  EXPECT_NEAR(parted.result.thickness, 0.02, 0.005);
  EXPECT_EQ(parted.ground.size(), 3000u);
  EXPECT_EQ(parted.result.inliers, 3000u);
  EXPECT_EQ(parted.obstacles.size(), 200u);
  EXPECT_GT(parted.result.confidence, 0.99);
}

TEST(Ground, NormalPointsUpWhereTheFloorSlopes) {
  const Parted parted = part(scene(1.5f, 0.1f));
  ASSERT_TRUE(parted.result.found());
  EXPECT_NEAR(parted.result.tilt, std::atan(0.1), 0.002);
  EXPECT_LT(parted.result.plane.normal.x(), 0.0);
  EXPECT_GT(parted.result.plane.normal.z(), 0.0);
}

TEST(Ground, UpIsMeasuredAgainstTheGivenDirection) {
  Cloud cloud = test::floor(2000, -2.f);
  for (Point& p : cloud) std::swap(p.x, p.z);  // the floor now lies at x = -2
  GroundFinder finder;
  EXPECT_EQ(part(finder, cloud).result.fault, GroundFault::kTilt);
  const Parted parted = part(finder, cloud, 0.0, Eigen::Vector3d::UnitX());
  ASSERT_TRUE(parted.result.found());
  EXPECT_NEAR(parted.result.plane.normal.x(), 1.0, 1e-6);
  EXPECT_NEAR(parted.result.plane.offset, 2.0, 1e-5);
}

TEST(Ground, WallAndCeilingAreNoGround) {
  Cloud wall = test::fillBox(3000, {8, -20, -2}, {8, 20, 5});
  EXPECT_EQ(part(wall).result.fault, GroundFault::kTilt);
  EXPECT_EQ(part(test::floor(3000, 2.f)).result.fault, GroundFault::kHeight);
}

TEST(Ground, PassesTheWholeCloudOnWithoutAPlane) {
  const Cloud wall = test::fillBox(500, {8, -20, -2}, {8, 20, 5});
  const Parted parted = part(wall);
  EXPECT_TRUE(parted.ground.empty());
  EXPECT_EQ(parted.obstacles.size(), wall.size());
  EXPECT_TRUE(std::isnan(parted.result.plane.offset));
  EXPECT_EQ(parted.result.confidence, 0.0);
  EXPECT_STRNE(describe(parted.result.fault), "");
}

TEST(Ground, ExpectedHeightChoosesAmongLevels) {
  const Cloud cloud =
      test::join({test::floor(1000, -1.7f, 0.f, 0.01f), test::floor(3000, -0.6f, 0.f, 0.01f)});
  EXPECT_NEAR(part(cloud).result.plane.offset, 0.6, 0.01);
  GroundParams params;
  params.sensor_height = 1.9;
  EXPECT_NEAR(part(cloud, params).result.plane.offset, 1.7, 0.01);
  params.sensor_height = 3.0;
  EXPECT_EQ(part(cloud, params).result.fault, GroundFault::kHeight);
}

TEST(Ground, PlaneWithMuchBelowItHasLowConfidence) {
  const Cloud cloud = test::join({test::floor(3000, -0.6f), test::fillBox(3000, {-9, -9, -2}, {9, 9, -1})});
  GroundParams params;
  params.min_confidence = 0.4;
  const Parted table = part(cloud, params);
  ASSERT_TRUE(table.result.found());
  EXPECT_EQ(table.result.below, 3000u);
  EXPECT_NEAR(table.result.confidence, 0.5, 0.01);
  params.min_confidence = 0.6;
  EXPECT_EQ(part(cloud, params).result.fault, GroundFault::kLowConfidence);
}

TEST(Ground, NarrowStripHasLowerConfidenceThanAWideFloor) {
  Cloud strip = test::floor(2000, -1.7f, 0.f, 0.05f);
  for (Point& p : strip) p.y *= 0.01f;
  GroundParams params;
  params.min_confidence = 0.0;
  EXPECT_LT(part(strip, params).result.confidence, 0.7);
}

TEST(Ground, PointsBelowAreObstaclesUnlessTheyAreToBeDropped) {
  const Cloud cloud = test::join({test::floor(2000, -1.7f), test::line(5, 1.f, 3.f, 0.f, -2.5f)});
  const Parted kept = part(cloud);
  EXPECT_EQ(kept.result.below, 5u);
  EXPECT_EQ(kept.obstacles.size(), 5u);
  GroundParams params;
  params.drop_below = true;
  const Parted dropped = part(cloud, params);
  EXPECT_EQ(dropped.result.below, 5u);
  EXPECT_TRUE(dropped.obstacles.empty());
}

TEST(Ground, ThresholdIsInclusive) {
  GroundParams params;
  params.distance = 0.25;
  // An even, exact floor: the fit is exact too, and two points do not move it beyond 1 mm.
  const Cloud cloud = test::join({test::floor(20000, -2.f), {at(3, 0, -1.752f), at(4, 0, -1.748f)}});
  const Parted parted = part(cloud, params);
  ASSERT_EQ(parted.obstacles.size(), 1u);
  EXPECT_EQ(parted.obstacles[0].x, 4.f);
}

TEST(Ground, RefusesAHeightJumpUntilTheMemoryIsGone) {
  GroundFinder finder;
  EXPECT_TRUE(part(finder, scene(1.7f), 10.0).result.found());
  EXPECT_EQ(part(finder, scene(2.5f), 10.1).result.fault, GroundFault::kHeightChange);
  EXPECT_TRUE(part(finder, scene(1.9f), 10.2).result.found());
  EXPECT_TRUE(part(finder, scene(2.1f), 11.1).result.found());
  EXPECT_EQ(part(finder, scene(1.7f), 12.0).result.fault, GroundFault::kHeightChange);
  EXPECT_TRUE(part(finder, scene(1.7f), 12.2).result.found());
}

TEST(Ground, ForgetsOnResetAndWhenTimeRunsBack) {
  GroundFinder finder;
  EXPECT_TRUE(part(finder, scene(1.7f), 10.0).result.found());
  finder.reset();
  EXPECT_TRUE(part(finder, scene(3.f), 10.1).result.found());
  EXPECT_TRUE(part(finder, scene(1.7f), 5.0).result.found());
}

TEST(Ground, TooFewPointsAndDegenerateCloudsSaySo) {
  EXPECT_EQ(part({}).result.fault, GroundFault::kTooFewPoints);
  EXPECT_EQ(part({at(1, 0)}).result.fault, GroundFault::kTooFewPoints);
  EXPECT_EQ(part(Cloud(1000, at(3, 1, -2))).result.fault, GroundFault::kDegenerate);
  EXPECT_EQ(part(test::line(1000, 0.1f, -50.f, 0.f, -2.f)).result.fault, GroundFault::kDegenerate);
  GroundParams params;
  params.min_inliers = 2000;
  const Cloud cloud = test::join({test::floor(1000, -1.7f), test::fillBox(2000, {5, -9, 0}, {9, 9, 9})});
  const Parted parted = part(cloud, params);
  EXPECT_EQ(parted.result.fault, GroundFault::kTooFewInliers);
  EXPECT_EQ(parted.obstacles.size(), cloud.size());
}

TEST(Ground, LeavesOutAndCountsUnusablePoints) {
  Cloud cloud = scene(1.7f);
  cloud.insert(cloud.begin() + 100, {at(kNaN, 0), at(0, INFINITY), at(2e7f, 0)});
  const Parted parted = part(cloud);
  EXPECT_TRUE(parted.result.found());
  EXPECT_EQ(parted.result.unusable, 3u);
  EXPECT_EQ(parted.ground.size() + parted.obstacles.size(), cloud.size() - 3u);
}

TEST(Ground, SameInputGivesTheSamePlane) {
  const Cloud cloud = test::scanStreet().all;
  const Parted a = part(cloud), b = part(cloud);
  EXPECT_EQ(a.result.plane.normal, b.result.plane.normal);
  EXPECT_EQ(a.result.plane.offset, b.result.plane.offset);
}

TEST(Ground, StreetIsPartedAsItWasMade) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    test::StreetScan scan;
    scan.columns = 900;
    scan.seed = seed;
    const test::StreetClouds street = test::scanStreet(scan);
    const Parted parted = part(street.all);
    ASSERT_TRUE(parted.result.found()) << describe(parted.result.fault);
    EXPECT_NEAR(parted.result.plane.offset, 1.8, 0.03);
    EXPECT_LT(parted.result.tilt, radians(0.3));
    const auto true_ground = static_cast<double>(street.all.size() - street.off_ground.size());
    EXPECT_GT(static_cast<double>(parted.ground.size()), 0.99 * true_ground);
    for (const Point& p : parted.ground) EXPECT_LT(p.z, -1.8f + 0.4f);
    for (const Point& p : parted.obstacles) EXPECT_GT(p.z, -1.8f + 0.05f);
  }
}

TEST(Ground, OnEvenGroundBothMethodsPartAlike) {
  GroundParams plane;
  plane.method = GroundMethod::kPlane;
  const Parted a = part(scene(1.7f)), b = part(scene(1.7f), plane);
  const auto xs = [](const Cloud& cloud) {
    std::vector<float> out;
    for (const Point& p : cloud) out.push_back(p.x);
    return out;
  };
  EXPECT_EQ(xs(a.ground), xs(b.ground));
  EXPECT_EQ(xs(a.obstacles), xs(b.obstacles));
}

TEST(Ground, SurfaceFollowsAHillThatThePlaneLeavesBehind) {
  const auto hill = [](double x, double) { return 0.03 * std::max(0.0, x - 15.0); };
  test::ReliefScan scan;
  scan.max_range = 45.0;
  const Cloud cloud = test::scanRelief(hill, scan);
  GroundParams plane;
  plane.method = GroundMethod::kPlane;
  EXPECT_EQ(part(cloud).obstacles.size(), 0u);
  EXPECT_GT(part(cloud, plane).obstacles.size(), cloud.size() / 50);
}

TEST(Ground, WhatIsBelowIsJudgedFromTheSurface) {
  const auto hill = [](double x, double) { return 0.05 * std::max(0.0, x - 10.0); };
  Cloud cloud = test::scanRelief(hill);
  const std::size_t road = cloud.size();
  for (int i = 0; i < 10; ++i) cloud.push_back(at(25.f + 0.1f * static_cast<float>(i), 0, -1.6f));
  GroundParams params;
  params.drop_below = true;
  const Parted dropped = part(cloud, params), kept = part(cloud);
  EXPECT_EQ(kept.obstacles.size(), dropped.obstacles.size() + 10);
  EXPECT_GT(dropped.ground.size(), road * 98 / 100);
}

/// Ground whose intensity falls with the grazing angle from `brightness` hit squarely, 1.3 m below the
/// sensor, and 30 points of intensity `float_brightness` of a pipe that reaches 0.1 m above it.
Cloud harbour(float brightness, float float_brightness) {
  Cloud cloud = test::floor(3000, -1.3f, 0.f, 0.02f);
  for (Point& p : cloud) p.intensity = brightness * 1.3f / p.position().norm();
  for (int i = 0; i < 30; ++i) {
    cloud.push_back(at(9, 0.1f * static_cast<float>(i), -1.2f));
    cloud.back().intensity = float_brightness;
  }
  return cloud;
}

TEST(Ground, WhatIsBrighterThanWaterFloats) {
  GroundParams params;
  EXPECT_EQ(part(harbour(0.5f, 12.f), params).obstacles.size(), 0u);
  params.bright = 3.0;
  EXPECT_EQ(part(harbour(0.5f, 12.f), params).obstacles.size(), 30u);
  EXPECT_EQ(part(harbour(0.5f, 2.f), params).obstacles.size(), 0u);
}

// concrete hit squarely sends back as much as a pipe does
TEST(Ground, OnLandBrightnessTellsNothing) {
  GroundParams params;
  params.bright = 3.0;
  EXPECT_EQ(part(harbour(25.f, 40.f), params).obstacles.size(), 0u);
  EXPECT_EQ(part(harbour(25.f, 60.f), params).obstacles.size(), 30u);
}

TEST(Ground, AnIntensityThatIsNotKnownIsNotBright) {
  GroundParams params;
  params.bright = 3.0;
  EXPECT_EQ(part(harbour(0.5f, kNaN), params).obstacles.size(), 0u);
  EXPECT_EQ(part(harbour(kNaN, kNaN), params).obstacles.size(), 0u);
}

TEST(Ground, RefusesAnUpThatIsNoUnitVector) {
  GroundFinder finder;
  EXPECT_THROW(part(finder, {}, 0.0, Eigen::Vector3d(0, 0, 2)), std::invalid_argument);
  EXPECT_THROW(part(finder, {}, 0.0, Eigen::Vector3d(0, kNaN, 1)), std::invalid_argument);
}

TEST(Ground, RefusesParametersOutOfRange) {
  GroundParams params;
  params.distance = -0.2;
  EXPECT_THROW(GroundFinder{params}, std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
