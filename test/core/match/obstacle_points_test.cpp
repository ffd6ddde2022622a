#include "field_fusion/core/match/obstacle_points.h"

#include <gtest/gtest.h>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

ObstacleBody lidarBody(std::uint32_t first, std::uint32_t count, double existence = 0.7) {
  ObstacleBody out;
  out.existence = existence;
  out.points = {first, count};
  out.position.setConstant(kNaN);
  return out;
}

ObstacleBody cameraBody(double x, double y, double z, double radius, double existence = 0.7) {
  ObstacleBody out;
  out.existence = existence;
  out.position = {x, y, z};
  out.radius = radius;
  return out;
}

Cloud lidarPoints(const std::vector<ObstacleBody>& bodies, const Cloud& points,
                  const ObstaclePointsParams& params, const Transform& T = Transform::Identity()) {
  Cloud out;
  appendLidarPoints(bodies, points, T, params, out);
  return out;
}

Cloud cameraPoints(const ObstacleBody& body, const ObstaclePointsParams& params = {}, double spacing = 0.1) {
  Cloud out;
  appendCameraPoints({body}, spacing, Transform::Identity(), params, out);
  return out;
}

TEST(LidarPoints, AreThoseOfBodiesThatExistSurelyEnough) {
  const Cloud points{at(1, 0, 0), at(2, 0, 0), at(3, 0, 0), at(4, 0, 0), at(5, 0, 0)};
  ObstaclePointsParams params;
  params.min_existence = 0.5;
  const auto out =
      lidarPoints({lidarBody(0, 1, 0.49), lidarBody(1, 2, 0.5), lidarBody(3, 1, kNaN)}, points, params);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].x, 2.f);
  EXPECT_EQ(out[1].x, 3.f);
  EXPECT_TRUE(lidarPoints({}, points, params).empty());
}

TEST(LidarPoints, AreMovedAndThenHeldAgainstTheBandWithItsLimits) {
  const Cloud points{at(1, 0, -2),   at(1, 0, -1),  at(1, 0, 1),
                     at(1, 0, 1.5f), at(NAN, 0, 0), at(0, INFINITY, 0)};
  ObstaclePointsParams params;
  params.min_height = 0.0;
  params.max_height = 2.0;
  Transform T = Transform::Identity();
  T.translation() = Eigen::Vector3d(10, 20, 1);
  const auto out = lidarPoints({lidarBody(0, 6)}, points, params, T);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].position(), Eigen::Vector3f(11, 20, 0));
  EXPECT_EQ(out[1].position(), Eigen::Vector3f(11, 20, 2));
}

TEST(CameraPoints, LieOnTheHalfOfTheOutlineThatFacesTheOrigin) {
  const Eigen::Vector2f centre(3, 4);  // 5 m away
  const auto out = cameraPoints(cameraBody(3, 4, 0.5, 1.0));
  ASSERT_EQ(out.size(), 33u);  // pi m of outline in steps of at most 0.1 m
  float nearest = 100.f;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Eigen::Vector2f p = out[i].position().head<2>();
    EXPECT_NEAR((p - centre).norm(), 1.0, 1e-5);
    EXPECT_LE((p - centre).dot(centre), 1e-5);  // never behind the middle
    EXPECT_EQ(out[i].z, 0.5f);
    if (i > 0) {
      EXPECT_LE((out[i].position() - out[i - 1].position()).norm(), 0.1);
    }
    nearest = std::min(nearest, p.norm());
  }
  EXPECT_NEAR(nearest, 4.0, 1e-5);
}

TEST(CameraPoints, UnknownSizeIsTheParametersAndHeightsComeIntoTheBand) {
  ObstaclePointsParams params;
  params.camera_radius = 2.0;
  params.max_height = 1.0;
  const auto out = cameraPoints(cameraBody(10, 0, 6, kNaN), params);
  ASSERT_FALSE(out.empty());
  EXPECT_NEAR((out.front().position() - Eigen::Vector3f(10, 0, 1)).norm(), 2.0, 1e-5);
  EXPECT_EQ(out.front().z, 1.f);
}

TEST(CameraPoints, BodyDoesNotReachBeyondTheOrigin) {
  for (const auto& p : cameraPoints(cameraBody(1, 0, 0, 3.0)))
    EXPECT_LE((p.position() - Eigen::Vector3f(1, 0, 0)).norm(), 1.00001);
  EXPECT_EQ(cameraPoints(cameraBody(0, 0, 0, 3.0)).size(), 1u);
  EXPECT_EQ(cameraPoints(cameraBody(5, 0, 0, 0.0)).size(), 1u);
}

TEST(CameraPoints, NoneWithoutPositionExistenceOrWish) {
  ObstaclePointsParams params;
  EXPECT_TRUE(cameraPoints(cameraBody(kNaN, kNaN, kNaN, 1.0)).empty());
  EXPECT_TRUE(cameraPoints(cameraBody(5, 0, 0, 1.0, 0.4)).empty());
  params.camera_alone = false;
  EXPECT_TRUE(cameraPoints(cameraBody(5, 0, 0, 1.0), params).empty());
}

TEST(CameraPoints, BodyWithPointsOfTheLidarNeedsNone) {
  auto body = cameraBody(5, 0, 0, 1.0);
  body.points = {0, 3};
  EXPECT_TRUE(cameraPoints(body).empty());
}

}  // namespace
}  // namespace field_fusion::core
