#include "field_fusion/ros/camera_model.h"

#include <gtest/gtest.h>

#include "support/faults.h"

namespace field_fusion {
namespace {

/// 64x64 px, fx = fy = 20, the optical axis at (32, 32).
sensor_msgs::CameraInfo info() {
  sensor_msgs::CameraInfo out;
  out.width = out.height = 64;
  out.distortion_model = "plumb_bob";
  out.D.assign(5, 0.0);
  out.K = {20, 0, 32, 0, 20, 32, 0, 0, 1};
  out.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  out.P = {20, 0, 32, 0, 0, 20, 32, 0, 0, 0, 1, 0};
  return out;
}

std::string faultAfter(void (*damage)(sensor_msgs::CameraInfo&)) {
  auto damaged = info();
  damage(damaged);
  return test::faultOf([&] { CameraModel model(damaged); });
}

TEST(CameraModel, BoxWithoutDistortionStaysUpToThePixelConvention) {
  const auto box = CameraModel(info()).rectified({10.f, 20.f, 30.f, 40.f});
  EXPECT_FLOAT_EQ(box.x_min, 9.5f);  // corner-based to centre-based pixels
  EXPECT_FLOAT_EQ(box.y_max, 39.5f);
}

TEST(CameraModel, DistortionIsTakenOut) {
  auto barrel = info();
  barrel.D[0] = -0.1;  // k1: r' = r (1 - 0.1 r^2)
  // a point at normalised x = 0.5, y = 0 is seen at 0.5 (1 - 0.1 * 0.25) = 0.4875, i.e. 41.75 px + 0.5
  const auto box = CameraModel(barrel).rectified({42.25f, 32.5f, 42.25f, 32.5f});
  EXPECT_NEAR(box.x_min, 42.0, 0.01);  // 32 + 20 * 0.5
}

TEST(CameraModel, WithoutDistortionKCountsAndNotP) {
  auto other = info();
  other.P[0] = other.P[5] = 10.0;  // pixels stay as they are: P does not describe them
  EXPECT_EQ(CameraModel(other).pinhole().fx, 20.0);
}

TEST(CameraModel, DriversWithoutDistortionMayNameNoModel) {
  auto bare = info();
  bare.distortion_model = "";
  bare.D.clear();
  EXPECT_EQ(CameraModel(bare).pinhole().fx, 20.0);
}

TEST(CameraModel, BinnedAndCutImagesHaveTheirOwnSize) {
  auto binned = info();
  binned.binning_x = binned.binning_y = 2;
  EXPECT_EQ(CameraModel(binned).width(), 32u);
  EXPECT_NEAR(CameraModel(binned).pinhole().fx, 10.0, 1e-9);
  auto region = info();
  region.roi.width = 40;
  region.roi.height = 30;
  EXPECT_EQ(CameraModel(region).width(), 40u);
  EXPECT_EQ(CameraModel(region).height(), 30u);
}

TEST(CameraModel, WhatDescribesNoCameraIsNamed) {
  using Info = sensor_msgs::CameraInfo;
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.K.assign(0.0); }), "camera info is not calibrated: K"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.P.assign(0.0); }), "camera info is not calibrated: P"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.D[1] = std::nan(""); }), "camera info is not finite"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.width = 0; }), "camera info has no size"));
  EXPECT_TRUE(
      test::says(faultAfter([](Info& i) { i.distortion_model = "weird", i.D[0] = 0.1; }),
                 "camera info has a distortion that is not understood: model 'weird' with 5 numbers"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.D.assign(2, 0.1); }), "with 2 numbers"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.R.assign(0.0), i.D[0] = 0.1; }), "R is no rotation"));
  EXPECT_TRUE(test::says(faultAfter([](Info& i) { i.D = {1e9, -1e9, 0.0, 0.0, 1e9}; }), "turns the image inside out"));
}

TEST(CameraModel, LensesThatSeeNothingAreNamed) {
  const std::string words = "camera info is not plausible: of an image of 64x64 pixels, K has focal lengths ";
  EXPECT_EQ(faultAfter([](auto& i) { i.K[0] = 1e-30; }), words + "1e-30 and 20, middle 32, 32");
  EXPECT_EQ(faultAfter([](auto& i) { i.K[4] = 1e9; }), words + "20 and 1e+09, middle 32, 32");
  EXPECT_EQ(faultAfter([](auto& i) { i.K[2] = -1e9; }), words + "20 and 20, middle -1e+09, 32");
  EXPECT_NE(faultAfter([](auto& i) { i.P[6] = 1e9; }).find("P has focal lengths"), std::string::npos);
}

TEST(CameraModel, DriversWithoutDistortionMayLeaveRAtZero) {
  auto bare = info();
  bare.R.assign(0.0);
  EXPECT_FLOAT_EQ(CameraModel(bare).rectified({10.f, 20.f, 30.f, 40.f}).x_min, 9.5f);
}

}  // namespace
}  // namespace field_fusion
