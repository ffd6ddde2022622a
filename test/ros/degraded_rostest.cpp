// usv.launch with a detector that cannot start: the rest goes on by the LiDAR alone, and /diagnostics says
// why.
#include <gtest/gtest.h>

#include "field_fusion/ObstacleArray.h"
#include "field_fusion/ros/cloud_message.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

TEST(Degraded, WithoutADetectorTheLidarGoesOnAndDiagnosticsNameTheCause) {
  Received<ObstacleArray> obstacles("obstacles");
  Sender<CloudMessage> points("points");
  Diagnostics diagnostics;
  double now = 1000.0;
  const auto send = [&] {
    CloudMessage cloud;
    cloud.header.frame_id = "lidar";
    cloud.header.stamp.fromSec(now += 0.1);
    for (int i = 0; i < 20; ++i) cloud.points.push_back({3.f, 0.f, 0.05f * i});
    points.send(cloud);
  };
  ASSERT_TRUE(spinUntil([&] { return obstacles.count > 0; }, send));
  ASSERT_EQ(obstacles.last->obstacles.size(), 1u);
  EXPECT_EQ(obstacles.last->obstacles[0].source, Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(obstacles.last->obstacles[0].reason, Obstacle::NO_PARTNER_MESSAGE);
  EXPECT_EQ(obstacles.last->revision, 0);

  const auto refused = [&] { return diagnostics.of("detect"); };
  ASSERT_TRUE(spinUntil([&] { return refused() != nullptr; }, send));
  EXPECT_EQ(refused()->level, diagnostic_msgs::DiagnosticStatus::ERROR);
  EXPECT_NE(refused()->message.find("/no/such/model.onnx"), std::string::npos) << refused()->message;
  const auto waits = [&] { return diagnostics.says("match", "waiting for detections"); };
  EXPECT_TRUE(spinUntil(waits, send));
}

}  // namespace
}  // namespace field_fusion::test
