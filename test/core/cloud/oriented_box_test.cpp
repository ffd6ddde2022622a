#include "field_fusion/core/cloud/oriented_box.h"

#include <gtest/gtest.h>

#include <random>

#include "field_fusion/core/cloud/cluster.h"
#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

constexpr float kLength = 4.2f, kWidth = 1.8f, kNoiseSigma = 0.02f;

/// Points of a car's rear, and of its left side where `sides` is 2, that stands turned by `yaw` [rad] with
/// the corner between the two at (10, -3); every 10 cm in three heights, with Gaussian noise.
Cloud carFaces(float yaw, int sides) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.f, kNoiseSigma);
  Cloud out;
  const auto add = [&](float along, float across) {
    for (const float z : {-1.f, -0.5f, 0.f}) {
      const float u = along + noise(random), v = across + noise(random);
      out.push_back(
          at(10.f + u * std::cos(yaw) - v * std::sin(yaw), -3.f + u * std::sin(yaw) + v * std::cos(yaw), z));
    }
  };
  for (float v = 0.f; v < kWidth + 0.01f; v += 0.1f) add(0.f, -v);
  for (float u = 0.1f; sides > 1 && u < kLength + 0.01f; u += 0.1f) add(u, 0.f);
  return out;
}

OrientedBox boxOf(const Cloud& cloud) { return OrientedBoxFitter().fit(cloud.data(), cloud.size()); }

/// [rad] between two directions of a line.
double turnBetween(double a, double b) { return std::abs(std::remainder(a - b, radians(180.0))); }

class OrientedBoxOfACar : public testing::TestWithParam<double> {};

TEST_P(OrientedBoxOfACar, HasLengthAndWidthWhereTwoFacesAreSeen) {
  const double yaw = radians(GetParam());
  const OrientedBox box = boxOf(carFaces(static_cast<float>(yaw), 2));
  EXPECT_NEAR(box.size.x(), kLength, 6 * kNoiseSigma);
  EXPECT_NEAR(box.size.y(), kWidth, 6 * kNoiseSigma);
  EXPECT_FLOAT_EQ(box.size.z(), 1.f);
  EXPECT_LT(turnBetween(box.yaw, yaw), radians(1.0));
  const double c = std::cos(yaw), s = std::sin(yaw), u = 0.5 * kLength, v = -0.5 * kWidth;
  EXPECT_NEAR(box.centre.x(), 10.0 + u * c - v * s, 3 * kNoiseSigma);
  EXPECT_NEAR(box.centre.y(), -3.0 + u * s + v * c, 3 * kNoiseSigma);
  EXPECT_FLOAT_EQ(box.centre.z(), -0.5f);
}

TEST_P(OrientedBoxOfACar, HasTheWidthOfTheOneFaceSeen) {
  const double yaw = radians(GetParam());
  const OrientedBox box = boxOf(carFaces(static_cast<float>(yaw), 1));
  EXPECT_NEAR(box.size.x(), kWidth, 6 * kNoiseSigma);
  EXPECT_LT(box.size.y(), 8 * kNoiseSigma);
  EXPECT_LT(turnBetween(box.yaw, yaw + radians(90.0)), radians(1.5));
}

INSTANTIATE_TEST_SUITE_P(AllRound, OrientedBoxOfACar,
                         testing::Values(0.0, 1.0, 13.0, 33.3, 45.0, 58.0, 89.0, 90.0, 117.0, 179.0));

TEST(OrientedBox, OfOnePointHasNoSize) {
  const OrientedBox box = boxOf({at(3, -4, 5)});
  EXPECT_EQ(box.centre, Eigen::Vector3f(3, -4, 5));
  EXPECT_EQ(box.size, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(box.yaw, 0.f);
}

TEST(OrientedBox, OfEqualPointsHasNoSize) {
  EXPECT_EQ(boxOf(Cloud(1000, at(3, -4, 5))).size, Eigen::Vector3f(0, 0, 0));
}

TEST(OrientedBox, OfALineHasItsLengthAndDirection) {
  Cloud cloud;
  for (int i = 0; i < 50; ++i) cloud.push_back(at(-0.1f * i, 0.1f * i));
  const OrientedBox box = boxOf(cloud);
  EXPECT_NEAR(box.size.x(), 4.9 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(box.size.y(), 0.0, 0.02);
  EXPECT_LT(turnBetween(box.yaw, radians(135.0)), radians(0.2));
}

TEST(OrientedBox, HoldsAllPointsOfALargeCluster) {
  const Cloud cloud = test::fillBox(5000, {5.f, -2.f, -1.f}, {9.f, 1.f, 1.f});
  const OrientedBox box = boxOf(cloud);
  EXPECT_GE(box.yaw, radians(-90.0) - 1e-6);
  EXPECT_LT(box.yaw, radians(90.0));
  const Eigen::AngleAxisf turn_back(-box.yaw, Eigen::Vector3f::UnitZ());
  for (const Point& p : cloud) {
    const Eigen::Vector3f q = (turn_back * (p.position() - box.centre)).cwiseAbs();
    ASSERT_TRUE((q.array() <= 0.5f * box.size.array() + 1e-4f).all());
  }
}

TEST(OrientedBox, OfAClusterIsNaNOnlyWhereNotAskedFor) {
  ClusterParams params;
  Clusterer clusterer(params);
  const Cloud cloud = carFaces(0.5f, 2);
  EXPECT_NEAR(clusterer.run(cloud).clusters.at(0).oriented_box.size.y(), kWidth, 6 * kNoiseSigma);
  params.oriented_boxes = false;
  clusterer.setParams(params);
  const OrientedBox none = clusterer.run(cloud).clusters.at(0).oriented_box;
  EXPECT_TRUE(std::isnan(none.yaw) && none.size.array().isNaN().all() && none.centre.array().isNaN().all());
}

}  // namespace
}  // namespace field_fusion::core
