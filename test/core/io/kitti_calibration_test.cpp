#include <gtest/gtest.h>

#include <regex>

#include "field_fusion/core/io/kitti.h"
#include "support/faults.h"
#include "support/kitti_folder.h"

namespace field_fusion::core {
namespace {

using test::says;

KittiCalibration read(const std::string& text) {
  const test::TempFolder folder;
  return readKittiCalibration(folder.write("calib.txt", text));
}

std::string faultOf(const std::string& text) {
  return test::faultOf([&] { read(text); });
}

/// The made-up calibration with the line of one key replaced.
std::string with(const std::string& key, const std::string& line) {
  return std::regex_replace(std::string(test::kKittiCalibration), std::regex(key + ":[^\n]*\n"), line + "\n");
}

TEST(KittiCalibration, PutsTheColourCameraBesideTheReference) {
  const KittiCalibration calibration = read(test::kKittiCalibration);
  EXPECT_EQ(calibration.camera.fx, 100.0);
  EXPECT_EQ(calibration.camera.cy, 24.0);
  // 5 m ahead, 1 m left, 2 m up of the LiDAR; 0.06 m is what P2 says the frame's origin is moved by
  const Eigen::Vector3d seen = calibration.T_camera_lidar * Eigen::Vector3d(5, 1, 2);
  EXPECT_TRUE(seen.isApprox(Eigen::Vector3d(-1 + 0.06, -2, 5), 1e-12)) << seen.transpose();
}

TEST(KittiCalibration, ProjectsAsKittiDoes) {
  const std::string text =
      "P2: 700 0 600 45 0 700 180 -0.3 0 0 1 0.005\nR_rect 0.8 -0.6 0 0.6 0.8 0 0 0 1\n"
      "Tr_velo_cam 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n";
  const KittiCalibration calibration = read(text);
  Eigen::Matrix<double, 3, 4> P2;
  P2 << 700, 0, 600, 45, 0, 700, 180, -0.3, 0, 0, 1, 0.005;
  Eigen::Matrix4d R = Eigen::Matrix4d::Identity(), Tr = R;
  R.topLeftCorner<2, 2>() << 0.8, -0.6, 0.6, 0.8;
  Tr.topRows<3>() << 0, -1, 0, 0.1, 0, 0, -1, -0.2, 1, 0, 0, -0.3;

  const Eigen::Vector3d point(12, -3, 0.5);
  const Eigen::Vector3d expected = P2 * R * Tr * point.homogeneous();
  const Eigen::Vector3d seen = calibration.T_camera_lidar * point;
  const Pinhole& camera = calibration.camera;
  EXPECT_NEAR(camera.fx * seen.x() / seen.z() + camera.cx, expected.x() / expected.z(), 1e-9);
  EXPECT_NEAR(camera.fy * seen.y() / seen.z() + camera.cy, expected.y() / expected.z(), 1e-9);
}

TEST(KittiCalibration, NamesAMissingKey) {
  for (const char* key : {"P2", "R0_rect", "Tr_velo_to_cam"})
    EXPECT_TRUE(says(faultOf(with(key, "")), std::string("calib.txt: no ") + key));
}

TEST(KittiCalibration, NamesAKeyWithTooFewNumbersOrText) {
  EXPECT_TRUE(says(faultOf(with("R0_rect", "R0_rect: 1 0 0")), "R0_rect should be 9 numbers, has 3"));
  EXPECT_TRUE(says(faultOf(with("P2", "P2: 1 0 x")), "P2 should be 12 numbers, has 2"));
}

TEST(KittiCalibration, RefusesWhatIsNoCameraOrNoRotation) {
  EXPECT_TRUE(says(faultOf(with("P2", "P2: 0 0 0 0 0 0 0 0 0 0 0 0")), "P2 is no pinhole camera"));
  EXPECT_TRUE(says(faultOf(with("R0_rect", "R0_rect: 2 0 0 0 1 0 0 0 1")), "R0_rect is no rotation"));
  EXPECT_TRUE(says(faultOf(with("R0_rect", "R0_rect: -1 0 0 0 1 0 0 0 1")), "R0_rect is no rotation"));
}

TEST(KittiCalibration, MissingFileIsNamed) {
  EXPECT_THROW(readKittiCalibration("/nowhere/calib.txt"), std::runtime_error);
}

TEST(KittiCalibration, RealLayoutsAllRead) {
  if (test::recording("").empty()) GTEST_SKIP() << "FIELD_FUSION_DATA is not set";
  for (const char* name : {"kitti_sequence", "kitti_object", "kitti_tracking"}) {
    const auto frames = listKitti(test::recording(name));
    const auto calibration = readKittiCalibration(frames.front().calibration);
    EXPECT_NEAR(calibration.camera.fx, 715.0, 10.0) << name;
    // Geiger et al. 2013, figure 3: the colour camera is 0.27 m ahead of the scanner and 0.08 m below it
    const Eigen::Vector3d lidar = calibration.T_camera_lidar.translation();
    EXPECT_NEAR(lidar.z(), -0.27, 0.07) << name;
    EXPECT_NEAR(lidar.y(), -0.08, 0.03) << name;
  }
}

}  // namespace
}  // namespace field_fusion::core
