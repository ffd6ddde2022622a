#include "field_fusion/core/map/slam_scan.h"

#include <gtest/gtest.h>

#include <limits>

namespace field_fusion::core {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
const ScanLimits kLimits{0.2, 5.0, 10.0};

Scan beams(std::vector<float> ranges, double first, double step) {
  Scan out;
  out.angle_min = radians(first), out.angle_increment = radians(step), out.range_max = 100.0;
  out.ranges = std::move(ranges);
  return out;
}

SlamScan scanOf(const std::vector<float>& ranges, const Transform& T = Transform::Identity()) {
  return slamScan(beams(ranges, 0.0, 90.0), T, kLimits);
}

TEST(SlamScan, LeavesOutWhatSaysNothing) {
  const SlamScan scan = scanOf({kNaN, kInf, -kInf, 0.f, -1.f, 0.1f, 10.f, 12.f});
  EXPECT_TRUE(scan.hits.empty());
  EXPECT_TRUE(scan.free.empty());
  EXPECT_TRUE(scanOf({}).hits.empty());
}

TEST(SlamScan, TheScannersOwnLimitsCountToo) {
  Scan scan = beams({0.4f, 2.f, 3.f}, 0.0, 90.0);
  scan.range_min = 0.5, scan.range_max = 2.5;
  EXPECT_EQ(slamScan(scan, Transform::Identity(), kLimits).hits.size(), 1u);
}

TEST(SlamScan, BeyondTheUsableRangeOnlyTheWayIsFree) {
  const SlamScan scan = scanOf({5.f, 7.f});
  ASSERT_EQ(scan.hits.size(), 1u);
  ASSERT_EQ(scan.free.size(), 1u);
  EXPECT_NEAR((scan.hits[0].end - Eigen::Vector2f(5, 0)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((scan.free[0] - Eigen::Vector2f(0, 5)).norm(), 0.0, 1e-5);
}

TEST(SlamScan, UpsideDownAndTurned) {
  Transform T = Transform::Identity();
  T.translation() << 0.3, 0.1, 0.5;
  T.linear() = Eigen::AngleAxisd(radians(180.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  const SlamScan scan = scanOf({1.f, 2.f}, T);  // its left is the robot's right
  EXPECT_NEAR((scan.origin - Eigen::Vector2f(0.3f, 0.1f)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((scan.hits[1].end - Eigen::Vector2f(0.3f, -1.9f)).norm(), 0.0, 1e-5);
}

TEST(SlamScan, KnowsItsWalls) {
  std::vector<float> ranges;
  for (int k = 0; k < 41; ++k) ranges.push_back(static_cast<float>(2.0 / std::cos(radians(k - 20.0))));  // x = 2
  const SlamScan wall = slamScan(beams(ranges, -20.0, 1.0), Transform::Identity(), kLimits);
  EXPECT_EQ(wall.hits.front().normal.norm(), 0.f) << "it has a neighbour on one side only";
  for (std::size_t k = 1; k + 1 < wall.hits.size(); ++k)
    EXPECT_NEAR(std::abs(wall.hits[k].normal.x()), 1.f, 1e-3f);
  ranges[20] = 1.f;  // a post before the wall: it and its neighbours are on no line
  const SlamScan post = slamScan(beams(ranges, -20.0, 1.0), Transform::Identity(), kLimits);
  for (const std::size_t k : {19u, 20u, 21u}) EXPECT_EQ(post.hits[k].normal.norm(), 0.f);
}

}  // namespace
}  // namespace field_fusion::core
