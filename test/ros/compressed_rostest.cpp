// The detector on compressed images (compressed.test); the model is that of detect.test.
#include <gtest/gtest.h>
#include <image_transport/image_transport.h>
#include <sensor_msgs/CompressedImage.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "field_fusion/ImageDetectionArray.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

bool installed() {
  const auto known = image_transport::ImageTransport(ros::NodeHandle()).getDeclaredTransports();
  return std::find(known.begin(), known.end(), "image_transport/compressed") != known.end();
}

sensor_msgs::CompressedImage redImage(double stamp) {
  sensor_msgs::CompressedImage image;
  image.header.frame_id = "camera_optical";
  image.header.stamp.fromSec(stamp);
  image.format = "bgr8; png compressed bgr8";
  cv::imencode(".png", cv::Mat(32, 32, CV_8UC3, cv::Scalar(0, 0, 255)), image.data);
  return image;
}

TEST(CompressedImages, AreTakenAsTheirPixelsAre) {
  if (!installed()) GTEST_SKIP() << "the image transport `compressed` is not installed on this machine";
  Received<ImageDetectionArray> detections("detections");
  Sender<sensor_msgs::CompressedImage> image("image/compressed");
  double now = 1000.0;
  ASSERT_TRUE(
      spinUntil([&] { return detections.last != nullptr; }, [&] { image.send(redImage(now += 0.1)); }));
  EXPECT_EQ(detections.last->header.frame_id, "camera_optical");
  ASSERT_EQ(detections.last->detections.size(), 1u);
  EXPECT_EQ(detections.last->detections[0].label, "red");
  EXPECT_NEAR(detections.last->detections[0].x_min, 8.f, 1e-3);
}

}  // namespace
}  // namespace field_fusion::test
