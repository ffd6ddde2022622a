#include "field_fusion/core/sim/scene_lidar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace field_fusion::core {
namespace {

SceneLidar exact() {
  SceneLidar lidar;
  lidar.range_noise = 0.0;
  lidar.columns = 360;
  return lidar;
}

SceneScan scanOf(const Scene& scene, const SceneLidar& lidar, unsigned seed = 1) {
  std::mt19937 random(seed);
  return scan(scene, 0.0, lidar, random);
}

TEST(SceneLidar, OfAnEmptySceneIsTheGround) {
  const SceneScan out = scanOf({}, exact());
  // rings at -15, -13, ..., +15 deg: the eight below the horizon meet the ground, -1 deg at 99.1 m
  EXPECT_EQ(out.cloud.size(), 8u * 360u);
  for (const Point& p : out.cloud) ASSERT_NEAR(p.z, -1.73f, 1e-5f);
  EXPECT_TRUE(out.body_points.empty());
}

TEST(SceneLidar, LosesWhatIsTooFar) {
  SceneLidar lidar = exact();
  lidar.max_range = 20.0;  // 1.73 m / sin 5 deg = 19.8, at 3 deg 33 m
  EXPECT_EQ(scanOf({}, lidar).cloud.size(), 6u * 360u);
}

TEST(SceneLidar, RowAndTimeFollowTheRay) {
  const SceneScan out = scanOf({}, exact());
  for (const Point& p : out.cloud) {
    const Polar ray = polar(p.position().cast<double>());
    ASSERT_NEAR(degrees(ray.elevation), -15.0 + 2.0 * p.ring, 1e-3);
    ASSERT_NEAR(p.time, 0.1 * ray.azimuth / radians(360.0), 1e-6);
  }
  EXPECT_LT(out.cloud.front().time, -0.0498f);
  EXPECT_GT(out.cloud.back().time, 0.0498f);
}

TEST(SceneLidar, CountsTheReturnsOfEachBody) {
  const Scene scene{{"wall", Body::Shape::kBox, {1, 20, 10}, {5.5, 0}},
                    {"behind it", Body::Shape::kBox, {1, 1, 3}, {9, 0}}};
  const SceneScan out = scanOf(scene, exact());
  int on_wall = 0;
  for (const Point& p : out.cloud) on_wall += std::abs(p.x - 5.f) < 1e-4f;
  EXPECT_EQ(out.body_points, (std::vector<int>{on_wall, 0}));
  EXPECT_GT(on_wall, 16 * 100);  // the wall spans 127 deg
}

TEST(SceneLidar, EachRaySeesTheSceneOfItsOwnTime) {
  // passes (10, 0) along x at 40 m/s; seen from its side, 0.025 s after the stamp, it is 1 m farther on
  Body body{"fast", Body::Shape::kBox, {0.2, 0.2, 4}, {0, 10}, {400, 0}, 20.0 * radians(180.0)};
  SceneLidar lidar = exact();
  lidar.columns = 3600;
  double sum = 0.0;
  const SceneScan out = scanOf({body}, lidar);
  ASSERT_GT(out.body_points[0], 0);
  for (const Point& p : out.cloud)
    if (p.y > 9.0f && p.z > -1.7f) {
      EXPECT_NEAR(p.x, 40.0 * p.time, 0.11);
      sum += p.time;
    }
  EXPECT_NEAR(sum / out.body_points[0], 0.0235, 0.001);
}

TEST(SceneLidar, NoiseHasTheGivenSpreadAndFollowsTheSeed) {
  SceneLidar lidar = exact();
  lidar.range_noise = 0.05;
  const Cloud noisy = scanOf({}, lidar).cloud, again = scanOf({}, lidar).cloud,
              other = scanOf({}, lidar, 2).cloud;
  double squares = 0.0;
  for (const Point& p : noisy) {
    const Polar ray = polar(p.position().cast<double>());
    squares += std::pow(ray.range - 1.73 / std::sin(-ray.elevation), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(noisy.size())), 0.05,
              0.003);  // 2880 rays: 1.3 % is one sigma
  EXPECT_EQ(noisy[100].x, again[100].x);
  EXPECT_NE(noisy[100].x, other[100].x);
}

}  // namespace
}  // namespace field_fusion::core
