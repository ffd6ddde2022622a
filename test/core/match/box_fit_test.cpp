#include "field_fusion/core/match/box_fit.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

using Eigen::Vector2d;

const ClassShape kCar{0.0, 0.0, 4.4, 1.8};

OrientedBox box(const Vector2d& centre, const Vector2d& size, double yaw_degrees) {
  OrientedBox out;
  out.centre = {static_cast<float>(centre.x()), static_cast<float>(centre.y()), 0.f};
  out.size = {static_cast<float>(size.x()), static_cast<float>(size.y()), 1.5f};
  out.yaw = static_cast<float>(radians(yaw_degrees));
  return out;
}

// 10 m ahead, its rear 1.8 m wide and 0.1 m of its roof are seen: it goes on for 4.4 m
TEST(BoxFit, OfARearTheLengthIsAddedBehind) {
  const BoxFit fit = completed(box({10.05, 0}, {1.8, 0.1}, 90.0), kCar, 0.1, 0.03);
  EXPECT_TRUE(fit.centre.isApprox(Vector2d(12.2, 0), 1e-4)) << fit.centre.transpose();
  EXPECT_TRUE(fit.size.isApprox(Vector2d(1.8, 4.4), 1e-4));
  EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), std::hypot(0.03, 0.22), 1e-4);
  EXPECT_LT(fit.covariance(1, 1), 0.002);
}

TEST(BoxFit, OfASideTheWidthIsAddedBehind) {
  const BoxFit fit = completed(box({0.2, -8.1}, {4.3, 0.2}, 0.0), kCar, 0.1, 0.03);
  EXPECT_TRUE(fit.centre.isApprox(Vector2d(0.2, -8.9), 1e-4)) << fit.centre.transpose();
  EXPECT_TRUE(fit.size.isApprox(Vector2d(4.3, 1.8), 1e-4));
}

// both near sides are seen, neither as long as nominal: the near corner stays
TEST(BoxFit, OverACornerBothSidesGrowAway) {
  const BoxFit fit = completed(box({10 + 2.0, 10 + 0.8}, {4.0, 1.6}, 0.0), kCar, 0.1, 0.03);
  EXPECT_TRUE(fit.centre.isApprox(Vector2d(12.2, 10.9), 1e-4)) << fit.centre.transpose();
}

TEST(BoxFit, WhatIsLargerThanItsClassStays) {
  const BoxFit fit = completed(box({15, 3}, {9.0, 3.0}, 30.0), kCar, 0.1, 0.03);
  EXPECT_TRUE(fit.centre.isApprox(Vector2d(15, 3), 1e-5));
  EXPECT_TRUE(fit.size.isApprox(Vector2d(9, 3), 1e-5));
}

TEST(BoxFit, TurnedIsTheSameTurned) {
  const BoxFit plain = completed(box({10.05, 0}, {1.8, 0.1}, 90.0), kCar, 0.1, 0.03);
  const Eigen::Rotation2Dd turn(radians(37.0));
  const BoxFit turned = completed(box(turn * Vector2d(10.05, 0), {1.8, 0.1}, 127.0 - 180.0), kCar, 0.1, 0.03);
  EXPECT_TRUE(turned.centre.isApprox(turn * plain.centre, 1e-5));
  const Eigen::Matrix2d R = turn.toRotationMatrix();
  EXPECT_TRUE(turned.covariance.isApprox(R * plain.covariance * R.transpose(), 1e-4));
}

}  // namespace
}  // namespace field_fusion::core
