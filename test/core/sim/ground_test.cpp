#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/core/sim/ride.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kPi = radians(180.0);

Ground water(std::vector<Wave> waves) {
  Ground ground;
  ground.kind = Ground::Kind::kWater;
  ground.waves = std::move(waves);
  return ground;
}

Ground roughGround(double roughness, double grain, unsigned seed) {
  Ground ground;
  ground.kind = Ground::Kind::kRough;
  ground.roughness = roughness;
  ground.grain = grain;
  ground.seed = seed;
  return ground;
}

TEST(SimGround, APlaneRisesByItsSlope) {
  Ground ground;
  ground.slope = {0.1, -0.2};
  EXPECT_DOUBLE_EQ(ground.height(3, 4, 9), 0.1 * 3 - 0.2 * 4);
  EXPECT_EQ(Ground{}.height(3, 4, 9), 0.0);
}

TEST(SimGround, NoneHasNoHeight) {
  Ground ground;
  ground.kind = Ground::Kind::kNone;
  EXPECT_TRUE(std::isnan(ground.height(0, 0, 0)));
}

TEST(SimGround, RoughnessIsTheStandardDeviation) {
  const Ground ground = roughGround(0.05, 2.0, 7);
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (double x = -150; x < 150; x += 1.3)
    for (double y = -150; y < 150; y += 1.3, ++n) {
      const double z = ground.height(x, y, 0);
      sum += z, squares += z * z;
    }
  EXPECT_NEAR(sum / n, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 0.003);
}

TEST(SimGround, BumpsAreNotShorterThanTheGrain) {
  const double grain = 1.5, roughness = 0.05, step = 0.01;
  const Ground ground = roughGround(roughness, grain, 3);
  double squares = 0.0;
  int n = 0;
  for (double x = -200; x < 200; x += 0.37, ++n)
    squares += std::pow((ground.height(x + step, 5, 0) - ground.height(x, 5, 0)) / step, 2);
  const double steepest = roughness * 2 * kPi / (2 * grain);  // all of it at the shortest wave length
  EXPECT_LT(std::sqrt(squares / n), steepest);
  EXPECT_GT(std::sqrt(squares / n), steepest / 2.5 / 2);  // and not all at the longest, seen along one axis
}

TEST(SimGround, RoughGroundIsItsSeeds) {
  const Ground a = roughGround(0.1, 2.0, 1), b = roughGround(0.1, 2.0, 2);
  const double first = a.height(3, 4, 0), other = b.height(3, 4, 0);
  EXPECT_NE(first, other);
  EXPECT_EQ(a.height(3, 4, 17), first);
}

TEST(SimGround, WavesRunAsInDeepWater) {
  const double length = 8.0, speed = std::sqrt(9.80665 * length / (2 * kPi));
  const Ground ground = water({{0.3, length, radians(90), 0.0}});
  EXPECT_NEAR(ground.height(5, 0, 0), 0.3, 1e-12);  // a crest along x
  EXPECT_NEAR(ground.height(5, length / 2, 0), -0.3, 1e-12);
  for (double t : {0.7, 3.0, 100.0}) EXPECT_NEAR(ground.height(0, speed * t, t), 0.3, 1e-9);
}

TEST(SimRide, UprightKeepsItsFeetOnTheGround) {
  Ground ground;
  ground.slope = {0.1, 0.0};
  const Trajectory way({{{5, 1, 0.25}, radians(30), 0.0}}, {});
  const Trajectory carried = carriedByGround(way, ground, Ride::kUpright, 1, 1);
  EXPECT_TRUE(carried.still());
  EXPECT_TRUE(carried.pose(0).translation().isApprox(Eigen::Vector3d(5, 1, 0.75)));
  EXPECT_TRUE(carried.pose(0).linear().isApprox(way.pose(0).linear()));
}

TEST(SimRide, LeaningStandsAlongTheSlope) {
  Ground ground;
  ground.slope = {0.1, 0.0};
  for (double yaw : {0.0, 90.0, 200.0}) {
    const Trajectory way({{{5, 1, 0}, radians(yaw), 0.0}}, {});
    const Transform pose = carriedByGround(way, ground, Ride::kLeaning, 2, 1).pose(0);
    EXPECT_NEAR(pose.translation().z(), 0.5, 1e-12);
    const Eigen::Vector3d normal = Eigen::Vector3d(-0.1, 0, 1).normalized();
    EXPECT_TRUE(pose.linear().col(2).isApprox(normal, 1e-9)) << yaw;
    EXPECT_NEAR(std::atan2(pose(1, 0), pose(0, 0)), angleDifference(radians(yaw), 0), 0.01);
    EXPECT_TRUE((pose.linear().transpose() * pose.linear()).isIdentity(1e-12));
    EXPECT_NEAR(pose.linear().determinant(), 1.0, 1e-12);
  }
}

TEST(SimRide, FloatingPitchesByTheWavesSlope) {
  const double length = 40.0, amplitude = 0.5, k = 2 * kPi / length;
  const Ground ground = water({{amplitude, length, 0.0, -kPi / 2}});  // sin(k x) at the start
  const Trajectory buoy = carriedByGround(Trajectory(), ground, Ride::kFloating, 0.5, 0.5);
  EXPECT_FALSE(buoy.still());
  const Eigen::Vector3d ahead = buoy.pose(0).linear().col(0);
  EXPECT_NEAR(std::atan2(ahead.z(), ahead.x()), std::atan(amplitude * k), 1e-3);
  EXPECT_NEAR(buoy.pose(0).translation().z(), 0.0, 1e-9);
  const double quarter = 2 * kPi / std::sqrt(9.80665 * k) / 4;  // sin(k x - w t): then a trough
  EXPECT_NEAR(buoy.pose(quarter).translation().z(), -amplitude, 1e-3);
}

TEST(SimRide, WavesShorterThanTheBodyMoveItLittle) {
  const Ground ground = water({{0.2, 2.0, 0.0, 0.0}});
  const Trajectory ship = carriedByGround(Trajectory(), ground, Ride::kFloating, 12, 4);
  for (double t = 0; t < 2; t += 0.1) EXPECT_LT(std::abs(ship.pose(t).translation().z()), 0.05);
}

TEST(SimRide, WithoutGroundAndFixedInWaterTheWayIsAll) {
  Ground none;
  none.kind = Ground::Kind::kNone;
  const Trajectory way({{{5, 1, 7}, 0.0, 0.0}}, {});
  for (const Ground& ground : {none, water({{0.3, 8.0, 0.0, 0.0}})})
    EXPECT_TRUE(carriedByGround(way, ground, Ride::kLeaning, 1, 1).pose(3).isApprox(way.pose(0)));
}

}  // namespace
}  // namespace field_fusion::core::sim
