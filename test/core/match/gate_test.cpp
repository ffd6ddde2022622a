#include "field_fusion/core/match/gate.h"

#include <gtest/gtest.h>

#include <random>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::lookingAhead;
using test::personAt;
using test::Solid;

constexpr double kRangeSigma = 0.05, kBearingSigma = 0.01;

Gate gate(double box_error = 0.0) {
  Gate out;
  out.setParams({0.997, box_error}, kRangeSigma, kBearingSigma);
  return out;
}

Sight sightAt(double range, double azimuth, double elevation = 0.0) {
  return {{range, azimuth, elevation}, 0.0, 0.0, 0.0};
}

CameraTarget target(double range, double azimuth, double elevation = 0.0, double range_sigma = 0.5) {
  CameraTarget out;
  out.seen = {range, azimuth, elevation};
  out.range_sigma = range_sigma;
  return out;
}

ViewBox boxOf(double width, double height) {
  return {std::tan(width / 2), -std::tan(width / 2), std::tan(height / 2), -std::tan(height / 2)};
}

TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 2), 5.991, 1e-3);
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.815, 1e-3);
  EXPECT_NEAR(chiSquareQuantile(0.99, 3), 11.345, 1e-3);
  EXPECT_NEAR(chiSquareQuantile(0.999, 2), 13.816, 1e-3);
}

TEST(Gate, TermsAreSquaredDifferencesOverVariances) {
  const Likeness l = gate().compare(sightAt(10.5, 0.02, -0.01), target(10.0, 0.0));
  EXPECT_NEAR(l.terms[0], 0.25 / (0.25 + kRangeSigma * kRangeSigma), 1e-9);
  EXPECT_NEAR(l.terms[1], 4.0, 1e-9);
  EXPECT_NEAR(l.terms[2], 1.0, 1e-9);
  EXPECT_NEAR(l.distance2, l.terms.sum(), 1e-12);
  EXPECT_TRUE(l.inside);
  EXPECT_NEAR(l.cost, l.distance2, 1e-9) << "nothing is loose here";
}

TEST(Gate, HoldsTheStatedShareOfTruePairs) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int with_range = 0, without = 0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double a = kBearingSigma * normal(random), e = kBearingSigma * normal(random);
    const double r = std::hypot(0.5, kRangeSigma) * normal(random);
    with_range += gate().compare(sightAt(10.0 + r, a, e), target(10.0, 0.0)).inside;
    without += gate().compare(sightAt(10.0 + r, a, e), target(kNaN, 0.0)).inside;
  }
  EXPECT_NEAR(with_range / double(n), 0.997, 6e-4);
  EXPECT_NEAR(without / double(n), 0.997, 6e-4);
}

TEST(Gate, LimitIsInside) {
  const double edge = kBearingSigma * std::sqrt(chiSquareQuantile(0.997, 2));
  EXPECT_TRUE(gate().compare(sightAt(10.0, edge * (1 - 1e-9)), target(kNaN, 0.0)).inside);
  EXPECT_FALSE(gate().compare(sightAt(10.0, edge * (1 + 1e-9)), target(kNaN, 0.0)).inside);
}

TEST(Gate, AzimuthIsComparedAcrossTheBack) {
  EXPECT_NEAR(gate().compare(sightAt(5, radians(179.9)), target(5, radians(-179.9))).terms[1],
              std::pow(radians(0.2) / kBearingSigma, 2), 1e-9);
}

TEST(Gate, UnknownDirectionOrClusterAroundTheCameraIsOutside) {
  EXPECT_FALSE(gate().compare(sightAt(5, 0), target(5, kNaN)).inside);
  EXPECT_FALSE(gate().compare(Sight{}, target(5, 0)).inside);
  EXPECT_TRUE(std::isnan(gate().compare(Sight{}, target(5, 0)).distance2));
}

// a slice of a body anywhere in its box, and a box anywhere in a cluster of two, are at most sqrt(3) sigma
// off
TEST(Gate, TheSmallerMayLieAnywhereInTheLarger) {
  for (const bool cluster_larger : {false, true}) {
    Sight sight = sightAt(10, 0);
    CameraTarget seen = target(10, 0);
    sight.width = sight.height = cluster_larger ? 0.4 : 0.1;
    seen.box = cluster_larger ? boxOf(0.1, 0.1) : boxOf(0.4, 0.4);
    sight.centre.azimuth = sight.centre.elevation = 0.15;
    const Likeness l = gate().compare(sight, seen);
    EXPECT_LT(l.terms[1], 3.0);
    EXPECT_GT(l.terms[1], 2.8);
    EXPECT_TRUE(l.inside);
  }
}

TEST(Gate, BetterFitInSizeCostsLess) {
  CameraTarget seen = target(10, 0);
  seen.box = boxOf(0.1, 0.3);
  Sight fitting = sightAt(10, 0.01), slice = sightAt(10, 0.0);
  fitting.width = 0.1, fitting.height = 0.3;
  slice.width = 0.01, slice.height = 0.02;
  const Likeness a = gate().compare(fitting, seen), b = gate().compare(slice, seen);
  EXPECT_GT(a.distance2, b.distance2);
  EXPECT_LT(a.cost, b.cost);
  EXPECT_LE(b.cost, gate().limit());
}

TEST(Sight, IsThatOfTheCameraWhereverItIsMounted) {
  std::vector<Point> points;
  const Solid wall{{10, 1, -1}, {10, 3, 1}};  // 2 m x 2 m, 2 m left of the axis
  const Cluster cluster = test::scan({wall}, points);
  Transform T_lidar_camera = lookingAhead({2, 2, 0});
  const Sight ahead = sightOf(cluster, test::viewFrom(T_lidar_camera).T_view_lidar);
  EXPECT_NEAR(ahead.centre.range, 8.0, 1e-5);
  EXPECT_NEAR(ahead.centre.azimuth, 0.0, 1e-6);
  EXPECT_NEAR(ahead.width, 2 * std::atan(1.0 / 8.0), 1e-5);
  EXPECT_NEAR(ahead.depth, 0.0, 1e-5);
  T_lidar_camera.rotate(Eigen::AngleAxisd(radians(90), Eigen::Vector3d::UnitZ()));  // about its own axis
  const Sight rolled =
      sightOf(test::scan({{{10, 1, 0}, {10, 3, 0.5}}}, points), test::viewFrom(T_lidar_camera).T_view_lidar);
  EXPECT_GT(rolled.height, rolled.width) << "what is wide in the world is high in its image";
}

TEST(Sight, OrientedBoxIsTakenWhereItIsKnown) {
  Cluster cluster;  // a wall 4 m long that runs away from the sensor at 45 deg
  cluster.box = {Eigen::Vector3f(10, 0, 0), Eigen::Vector3f(12.83f, 2.83f, 1)};
  cluster.centre = cluster.box.center();
  const Sight loose = sightOf(cluster, Transform::Identity());
  cluster.oriented_box = {cluster.centre, {4.f, 0.f, 1.f}, static_cast<float>(radians(45))};
  const Sight tight = sightOf(cluster, Transform::Identity());
  EXPECT_LT(tight.width, 0.9 * loose.width);
}

TEST(Sight, NothingIsKnownOfAClusterAtTheCameraOrWithoutTransform) {
  Cluster cluster;
  cluster.box = {Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 1)};
  EXPECT_TRUE(std::isnan(sightOf(cluster, Transform::Identity()).centre.range));
  cluster.centre = {5, 0, 0};
  EXPECT_TRUE(std::isnan(sightOf(cluster, Transform(Eigen::Matrix4d::Constant(kNaN))).centre.range));
}

TEST(Look, BoxAndDirectionAreThoseOfTheBody) {
  const Transform T_lidar_camera = lookingAhead({1, 0.5, 0.2});
  const CameraTarget person = test::seenBy(T_lidar_camera, personAt(6, -1), 3, 0.5);
  EXPECT_NEAR(person.box.left, (-0.75 - 0.5) / 5.15, 1e-9) << "the far edge on this side";
  EXPECT_NEAR(person.box.right, (-1.25 - 0.5) / 4.85, 1e-9);
  EXPECT_NEAR(person.box.top, 0.65 / 4.85, 1e-9);
  EXPECT_NEAR(person.seen.range, person.ray_range, 1e-12);
  EXPECT_TRUE(person.box.contains({4.85, -1.5, 0}));
  EXPECT_FALSE(person.box.contains({-4.85, 1.5, 0})) << "behind the camera";
  EXPECT_FALSE(person.box.contains({4.85, -1.0, 0}));
  EXPECT_TRUE(person.box.contains({4.85, -1.0, 0}, radians(3)));
}

TEST(Look, WhatIsNotKnownStaysNaN) {
  CameraTarget none;
  const Eigen::Vector3d nan = Eigen::Vector3d::Constant(kNaN);
  look(none, nan, nan, nan);
  EXPECT_FALSE(none.box.known());
  EXPECT_TRUE(std::isnan(none.seen.azimuth));
  look(none, {0, 0, 1}, {-1, -1, -0.1}, {0.1, 0.1, 1});
  EXPECT_FALSE(none.box.known()) << "more than half of the world";
  EXPECT_DOUBLE_EQ(none.seen.azimuth, 0.0);
}

}  // namespace
}  // namespace field_fusion::core
