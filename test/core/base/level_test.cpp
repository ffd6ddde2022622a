#include "field_fusion/core/base/level.h"

#include <gtest/gtest.h>

#include "field_fusion/core/base/fast_angle.h"

namespace field_fusion::core {
namespace {

Transform pose(double yaw, double pitch, double roll) {
  Transform out = Transform::Identity();
  out.translate(Eigen::Vector3d(3, -2, 0.4));
  out.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
  return out;
}

TEST(LevelPlane, TakesPitchAndRollOutAndLeavesTheHeading) {
  for (const double yaw : {0.0, 1.0, -3.0})
    for (const double pitch : {0.0, 0.3, -0.5})
      for (const double roll : {0.0, 0.4, -1.0}) {
        const Transform T_plane_body = overLevelPlane(pose(yaw, pitch, roll), 0.3);
        // the body without its yaw: pitch and roll alone are left
        Transform want = pose(0.0, pitch, roll);
        want.translation() << 0, 0, 0.3;
        EXPECT_TRUE(T_plane_body.isApprox(want, 1e-9)) << yaw << " " << pitch << " " << roll;
      }
}

TEST(LevelPlane, BodyOnEndHasNoHeading) {
  EXPECT_FALSE(overLevelPlane(pose(0.0, radians(90.0), 0.0), 0.0).matrix().allFinite());
}

TEST(FastAtan2, IsTheArctangentInAllQuadrants) {
  for (int i = -18000; i < 18000; ++i) {
    const double angle = radians(0.01 * i);
    for (const double range : {1e-3, 1.0, 1e4})
      ASSERT_NEAR(
          fastAtan2(static_cast<float>(range * std::sin(angle)), static_cast<float>(range * std::cos(angle))),
          angle, 2e-5);
  }
  EXPECT_EQ(fastAtan2(0.f, 0.f), 0.f);
  EXPECT_NEAR(fastAtan2(0.f, -1.f), radians(180.0), 1e-6);
}

}  // namespace
}  // namespace field_fusion::core
