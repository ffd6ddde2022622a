// Stages are unloaded and loaded again while messages pour in: the manager lives, and works afterwards.
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/ObstacleArray.h"
#include "field_fusion/ros/cloud_message.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

constexpr int kRounds = 30;

bool load(const std::string& stage, const std::vector<std::string>& from = {},
          const std::vector<std::string>& to = {}) {
  nodelet::NodeletLoad call;
  call.request.name = "/" + stage;
  call.request.type = "field_fusion/" + stage;
  call.request.remap_source_args = from;
  call.request.remap_target_args = to;
  return ros::service::call("manager/load_nodelet", call) && call.response.success;
}

bool unload(const std::string& stage) {
  nodelet::NodeletUnload call;
  call.request.name = "/" + stage;
  return ros::service::call("manager/unload_nodelet", call) && call.response.success;
}

class Reload : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("manager/load_nodelet", ros::Duration(20)));
  }

  CloudMessage nextCloud() {
    CloudMessage cloud;
    cloud.header.frame_id = "lidar";
    cloud.header.stamp.fromSec(now_ += 0.01);
    for (int i = 0; i < 5000; ++i) cloud.points.push_back({3.f, 0.001f * i, 0.f});
    return cloud;
  }
  static double now_;
};
double Reload::now_ = 1000.0;

TEST_F(Reload, ManagerOutlivesStagesThatGoWhileCloudsPourIn) {
  Sender<CloudMessage> points("/points");
  Received<ClusterArray> clusters("/clusters");
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_TRUE(load("filter")) << round;
    ASSERT_TRUE(load("cluster", {"/points"}, {"/points_filtered"})) << round;
    const int before = clusters.count;
    ASSERT_TRUE(spinUntil([&] { return clusters.count > before; },
                          [&] {
                            for (int i = 0; i < 5; ++i) points.send(nextCloud());
                          }))
        << round;
    for (int i = 0; i < 20; ++i) points.send(nextCloud());  // on their way while the stages go
    ASSERT_TRUE(unload("filter")) << round;
    ASSERT_TRUE(unload("cluster")) << round;
  }
}

TEST_F(Reload, ManagerOutlivesADetectorInTheMiddleOfAnImage) {
  ros::param::set("/detect/model", PROJECT_DIR "/test/fixtures/stock_head.onnx");
  Sender<sensor_msgs::Image> images("/image");
  Received<ImageDetectionArray> detections("/detections");
  sensor_msgs::Image image;
  image.encoding = "bgr8";
  image.width = image.height = 512;
  image.step = 3 * image.width;
  image.data.resize(image.height * image.step);
  const auto send = [&] {
    image.header.stamp.fromSec(now_ += 0.01);
    images.send(image);
  };
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_TRUE(load("detect")) << round;
    const int before = detections.count;
    ASSERT_TRUE(spinUntil([&] { return detections.count > before; }, send)) << round;
    for (int i = 0; i < 5; ++i) send();
    ASSERT_TRUE(unload("detect")) << round;
  }
}

TEST_F(Reload, ManagerOutlivesAMatcherThatStillWaits) {
  Sender<ClusterArray> clusters("/clusters");
  Received<ObstacleArray> obstacles("/obstacles");
  ClusterArray array;
  array.header.frame_id = "lidar";
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_TRUE(load("match")) << round;
    ASSERT_TRUE(spinUntil([&] { return clusters.connected(); })) << round;
    for (int i = 0; i < 5; ++i) {
      array.header.stamp.fromSec(now_ += 0.01);
      clusters.send(array);
    }
    ASSERT_TRUE(unload("match")) << round;
  }
  // it works after all that: clusters without a camera go out alone
  ASSERT_TRUE(load("match"));
  const int before = obstacles.count;
  EXPECT_TRUE(spinUntil([&] { return obstacles.count > before; },
                        [&] {
                          array.header.stamp.fromSec(now_ += 0.01);
                          clusters.send(array);
                        }));
}

}  // namespace
}  // namespace field_fusion::test
