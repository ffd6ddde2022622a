// Between the stages of usv.launch no message is serialised: each stage tells on /diagnostics where the last
// message of each input and output lay in memory, and what one stage sent is the very object the next one
// got.
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>

#include "field_fusion/ros/cloud_message.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

struct Link {
  const char *from, *output, *to, *input;
};

/// Every arrow between two stages of usv.launch.
constexpr Link kLinks[] = {
    {"filter", "/points_filtered", "ground", "points"}, {"ground", "/points_obstacle", "cluster", "points"},
    {"cluster", "/clusters", "match", "clusters"},      {"detect", "/detections", "match", "detections"},
    {"match", "/obstacles", "markers", "obstacles"},
};

/// One cloud with a post and one red image, of the same instant.
struct Frame {
  CloudMessage cloud;
  sensor_msgs::Image image;
  sensor_msgs::CameraInfo info;
};

Frame frameAt(double stamp) {
  Frame f;
  f.cloud.header.frame_id = f.image.header.frame_id = f.info.header.frame_id =
      "lidar";  // no transform needed
  f.cloud.header.stamp = f.image.header.stamp = f.info.header.stamp = ros::Time(stamp);
  for (int i = 0; i < 20; ++i) f.cloud.points.push_back({3.f, 0.f, 0.05f * i});
  f.image.encoding = "bgr8";
  f.image.width = f.image.height = f.info.width = f.info.height = 32;
  f.image.step = 96;
  f.image.data.assign(32 * 96, 255);
  f.info.K = {20, 0, 16, 0, 20, 16, 0, 0, 1};
  f.info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  f.info.P = {20, 0, 16, 0, 0, 20, 16, 0, 0, 0, 1, 0};
  f.info.D.assign(5, 0.0);
  f.info.distortion_model = "plumb_bob";
  return f;
}

TEST(Pointers, EachStageGetsTheObjectThatTheOneBeforeSent) {
  Received<visualization_msgs::MarkerArray> markers("markers");  // makes the whole chain listen
  Sender<CloudMessage> cloud("points");
  Sender<sensor_msgs::Image> image("image_raw");
  Sender<sensor_msgs::CameraInfo> info("camera_info");
  Diagnostics diagnostics;
  const auto output = [&](const Link& l) {
    return diagnostics.value(l.from, std::string(l.output) + ": last message");
  };
  const auto input = [&](const Link& l) {
    return diagnostics.value(l.to, std::string(l.input) + ": last message");
  };

  ASSERT_TRUE(spinUntil([&] { return cloud.connected() && image.connected() && info.connected(); }));
  // frames until one has gone through every stage; then no more, so that all stages tell of the same one
  double now = 1000.0;
  ASSERT_TRUE(spinUntil([&] { return markers.count > 3; },
                        [&] {
                          const auto frame = frameAt(now += 0.1);
                          info.send(frame.info);
                          image.send(frame.image);
                          cloud.send(frame.cloud);
                        }));
  for (const auto& link : kLinks) {
    const auto same = [&] { return !output(link).empty() && output(link) == input(link); };
    EXPECT_TRUE(spinUntil(same)) << link.from << " sent " << output(link) << " but " << link.to << " got "
                                 << input(link);
  }
}

}  // namespace
}  // namespace field_fusion::test
