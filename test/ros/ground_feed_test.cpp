#include "field_fusion/ros/ground_feed.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion {
namespace {

using Eigen::Vector3d;

TEST(CarriedPlane, HoldsTheSamePoints) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-3, 3);
  const auto any = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 100; ++i) {
    const core::Plane plane{any().normalized(), uniform(random)};
    const core::Transform T =
        Eigen::Translation3d(any()) * Eigen::AngleAxisd(uniform(random), any().normalized());
    const Vector3d p = any();
    EXPECT_NEAR(carried(plane, T).height(T * p), plane.height(p), 1e-12);
  }
}

// A LiDAR 2 m above the ground and a level camera 0.5 m below it, optical frame x right, y down.
TEST(CarriedPlane, IsTheCamerasHeightAboveTheGround) {
  core::Transform T_optical_lidar = core::Transform::Identity();
  T_optical_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T_optical_lidar.translation() = Vector3d(0, -0.5, 0);
  const core::Plane plane = carried({Vector3d::UnitZ(), 2.0}, T_optical_lidar);
  EXPECT_TRUE(plane.normal.isApprox(-Vector3d::UnitY()));
  EXPECT_DOUBLE_EQ(plane.offset, 1.5);
}

}  // namespace
}  // namespace field_fusion
