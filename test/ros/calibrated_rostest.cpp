// A camera whose driver sends no CameraInfo: its calibration comes from a file (calibrated.test).
#include <gtest/gtest.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <cmath>
#include <fstream>

#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/ros/camera_file.h"
#include "support/red_image.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

constexpr char kFile[] = PROJECT_DIR "/test/fixtures/camera.yaml";

// the model finds a box around (16, 16): 7.5 px right of and below the axis, as in detect_rostest
TEST(Calibrated, BearingComesWithoutTheTopicCameraInfo) {
  Received<ImageDetectionArray> detections("detections");
  Sender<sensor_msgs::Image> image("image");
  double now = 1000.0;
  ASSERT_TRUE(spinUntil([&] { return detections.last != nullptr; }, [&] { image.send(redImage(now += 0.1)); }));
  ASSERT_EQ(detections.last->detections.size(), 1u);
  EXPECT_NEAR(detections.last->detections[0].azimuth, -std::atan(7.5 / 20.0), 1e-5);
}

TEST(Calibrated, DiagnosticsMissNoCameraInfo) {
  Received<ImageDetectionArray> detections("detections");
  Sender<sensor_msgs::Image> image("image");
  Diagnostics diagnostics;
  double now = 2000.0;
  const auto well = [&] {
    const auto* status = diagnostics.of("detect");
    return status && status->level == diagnostic_msgs::DiagnosticStatus::OK && detections.last;
  };
  EXPECT_TRUE(spinUntil(well, [&] { image.send(redImage(now += 0.1)); }));
}

// as the button COMMIT of camera_calibration does
TEST(Calibrated, NewCalibrationHoldsAtOnceAndIsSaved) {
  const std::string path = testing::TempDir() + "calibrated_rostest.yaml";
  std::ofstream(path) << std::ifstream(kFile).rdbuf();
  CameraFile file(ros::NodeHandle("~camera"), "file://" + path);
  EXPECT_EQ(file.infoFor(redImage(1.0)).K[0], 20.0);

  sensor_msgs::SetCameraInfo call;
  call.request.camera_info = file.infoFor(redImage(1.0));
  call.request.camera_info.K[0] = call.request.camera_info.P[0] = 25.0;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ASSERT_TRUE(ros::service::call(ros::this_node::getName() + "/camera/set_camera_info", call));
  ASSERT_TRUE(call.response.success) << call.response.status_message;
  const sensor_msgs::CameraInfo info = file.infoFor(redImage(7.0));
  EXPECT_EQ(info.K[0], 25.0);
  EXPECT_EQ(info.header.stamp, ros::Time(7.0));
  EXPECT_EQ(info.header.frame_id, "camera_optical");
  EXPECT_EQ(CameraFile(ros::NodeHandle("~again"), "file://" + path).infoFor(redImage(1.0)).K[0], 25.0);
}

}  // namespace
}  // namespace field_fusion::test
