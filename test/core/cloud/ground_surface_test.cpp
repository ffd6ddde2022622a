#include "field_fusion/core/cloud/ground_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "field_fusion/core/cloud/ground.h"
#include "support/clouds.h"
#include "support/relief.h"

namespace field_fusion::core {
namespace {

using test::at;
using test::Relief;
using test::ReliefScan;

constexpr double kHeight = 1.8;  ///< [m] of the sensor
const Plane kLevel{Eigen::Vector3d::UnitZ(), kHeight};
const SurfaceLimits kLimits{radians(6.0), 0.15};

std::vector<double> measure(GroundSurface& surface, const Cloud& cloud, const Plane& plane = kLevel,
                            const SurfaceLimits& limits = kLimits) {
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<double> heights;
  surface.measure(cloud, all, plane, limits, heights);
  return heights;
}

std::vector<double> measure(const Cloud& cloud, const Plane& plane = kLevel,
                            const SurfaceLimits& limits = kLimits) {
  GroundSurface surface;
  return measure(surface, cloud, plane, limits);
}

double flat(double, double) { return 0.0; }
double ramp(double x, double) { return 0.1 * std::max(0.0, x - 10.0); }
double wave(double x, double) { return 0.2 * (1.0 - std::cos(x / 10.0)); }
double crown(double, double y) { return -0.03 * std::abs(y); }
double kerbs(double, double y) { return std::abs(y) > 3.0 ? 0.12 : 0.0; }
double kerbAcross(double x, double) { return x > 12.0 ? 0.12 : 0.0; }

/// A box with one corner at (15, -1) on `ground`.
Relief withBox(const Relief& ground, double length, double height) {
  return [=](double x, double y) {
    const bool in_box = x > 15.0 && x < 15.0 + length && std::abs(y) < 1.0;
    return ground(x, y) + (in_box ? height : 0.0);
  };
}

ReliefScan sixteenRings() {
  ReliefScan scan;
  scan.rings = 16;
  scan.lowest = radians(-15.0), scan.highest = radians(15.0);
  return scan;
}

double heightOver(const Relief& ground, const Point& p) { return p.z + kHeight - ground(p.x, p.y); }

/// All that lies on `ground` must be within 0.2 m of the surface, and what rises by more than 0.25 m above it
/// farther away; counts the latter.
int checkParted(const Relief& ground, const Relief& all, const ReliefScan& scan = {}) {
  const Cloud cloud = test::scanRelief(all, scan);
  const std::vector<double> heights = measure(cloud);
  int bodies = 0, on_ground = 0, lost = 0, swallowed = 0;
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const double truth = heightOver(ground, cloud[k]);
    const bool called_ground = std::abs(heights[k]) <= 0.2;
    if (truth < 0.01) ++on_ground, lost += !called_ground;
    if (truth > 0.25) ++bodies, swallowed += called_ground;
  }
  EXPECT_GT(on_ground, 1000);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(swallowed, 0);
  return bodies;
}

TEST(GroundSurface, FollowsGroundThatIsNoPlane) {
  for (const auto ground : {flat, ramp, wave, crown, kerbs, kerbAcross}) {
    ReliefScan scan;
    scan.max_range = 40.0;
    checkParted(ground, ground, scan);
  }
}

TEST(GroundSurface, FollowsSparseRingsAcrossEmptyCells) {
  for (const auto ground : {flat, kerbs, kerbAcross}) checkParted(ground, ground, sixteenRings());
  ReliefScan scan = sixteenRings();
  scan.max_range = 25.0;  // the next ring is 13 m farther out, and no slope is known so well
  const Relief bend = [](double x, double) { return 0.02 * std::max(0.0, x - 8.0); };
  checkParted(bend, bend, scan);
}

TEST(GroundSurface, WhatStandsOnTheGroundStaysAboveIt) {
  for (const auto ground : {flat, ramp, wave, kerbs}) {
    ReliefScan scan;
    scan.max_range = 40.0;
    EXPECT_GT(checkParted(ground, withBox(ground, 1.0, 0.3), scan), 0);   // a kerbstone
    EXPECT_GT(checkParted(ground, withBox(ground, 5.0, 0.3), scan), 50);  // cells full of it
    EXPECT_GT(checkParted(ground, withBox(ground, 4.0, 1.5), scan), 50);  // a car
  }
  EXPECT_GT(checkParted(flat, withBox(flat, 5.0, 0.3), sixteenRings()), 10);
}

TEST(GroundSurface, DoesNotClimbStepsAndWalls) {
  for (const double height : {0.5, 5.0})
    for (const ReliefScan& scan : {ReliefScan(), sixteenRings()})
      EXPECT_GT(checkParted(
                    flat, [=](double x, double) { return x > 15.0 ? height : 0.0; }, scan),
                200);
}

TEST(GroundSurface, ComesBackDownFromAPavementBehindAGap) {
  const Relief pavement = [](double x, double) { return x > 8.0 && x < 11.0 ? 0.14 : 0.0; };
  Cloud cloud = test::scanRelief(pavement);
  const auto hidden = [](const Point& p) { return p.x > 10.5f && p.x < 14.f; };
  cloud.erase(std::remove_if(cloud.begin(), cloud.end(), hidden), cloud.end());
  for (const double height : measure(cloud)) EXPECT_LE(std::abs(height), 0.2);
}

TEST(GroundSurface, DoesNotSinkIntoMirrorImages) {
  const Relief street = withBox(flat, 4.0, 1.5);
  Cloud cloud = test::scanRelief(street);
  const std::size_t real = cloud.size();
  for (std::size_t k = 0; k < real; ++k) {
    Point image = cloud[k];
    image.z = static_cast<float>(-2.0 * kHeight) - image.z;
    if (heightOver(flat, image) < -0.25) cloud.insert(cloud.end(), 3, image);
  }
  ASSERT_GT(cloud.size(), real + 200);
  const std::vector<double> heights = measure(cloud);
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const double truth = heightOver(flat, cloud[k]);
    if (std::abs(truth) > 0.01 && std::abs(truth) < 0.25) continue;
    EXPECT_EQ(std::abs(heights[k]) <= 0.2, std::abs(truth) <= 0.01) << "at " << truth;
    EXPECT_TRUE(truth > -0.25 || heights[k] < 0.0);
  }
}

TEST(GroundSurface, StaysInTheCorridorAboutThePlane) {
  const Cloud cloud = test::scanRelief(ramp);
  const std::vector<double> heights = measure(cloud, kLevel, {0.0, 0.15});
  for (std::size_t k = 0; k < cloud.size(); ++k)
    EXPECT_NEAR(heights[k], heightOver(flat, cloud[k]), 0.1 + 1e-5);  // what max_slope 0 leaves
}

TEST(GroundSurface, TiltedWithThePlaneNothingChanges) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 0.5).normalized()).matrix();
  Cloud cloud = test::scanRelief(withBox(flat, 4.0, 1.5)), turned = cloud;
  for (Point& p : turned) {
    const Eigen::Vector3f q = turn.cast<float>() * p.position();
    p.x = q.x(), p.y = q.y(), p.z = q.z();
  }
  const std::vector<double> heights = measure(turned, {turn * Eigen::Vector3d::UnitZ(), kHeight});
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const double truth = heightOver(flat, cloud[k]);
    if (truth > 0.01 && truth < 0.25) continue;
    EXPECT_EQ(std::abs(heights[k]) <= 0.2, truth < 0.25);
  }
}

TEST(GroundSurface, OrderOfThePointsAndEarlierCloudsChangeNothing) {
  const Cloud cloud = test::scanRelief(withBox(wave, 4.0, 1.5));
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Cloud shuffled;
  for (const std::size_t k : order) shuffled.push_back(cloud[k]);
  GroundSurface surface;
  const std::vector<double> first = measure(surface, cloud);
  const std::vector<double> other = measure(surface, shuffled);
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(other[k], first[order[k]]);
}

TEST(GroundSurface, FewAndFarPointsAreMeasuredFromThePlane) {
  EXPECT_TRUE(measure({}).empty());
  const Cloud cloud = {at(0, 0, -1.8f), at(30, 3, -1.f), at(200, 0, -1.8f), at(1e7f, -1e7f, 1e7f)};
  const std::vector<double> heights = measure(cloud);
  for (std::size_t k = 0; k < cloud.size(); ++k) EXPECT_NEAR(heights[k], cloud[k].z + kHeight, 1e-6);
}

TEST(GroundSurface, BeyondTheGridTheGroundIsThatOfItsBorder) {
  ReliefScan scan;
  scan.max_range = 58.0, scan.sector = radians(10.0), scan.height = 5.0;
  const Relief rise = [](double x, double) { return 0.02 * std::max(0.0, x - 10.0); };
  Cloud cloud = test::scanRelief(rise, scan);
  cloud.push_back(at(80, 0, -5.f));
  const double border = -measure(cloud, {Eigen::Vector3d::UnitZ(), 5.0}).back();
  EXPECT_GT(border, rise(58.0, 0.0) - 0.15);
  EXPECT_LT(border, rise(64.0, 0.0) + 0.05);
}

}  // namespace
}  // namespace field_fusion::core
