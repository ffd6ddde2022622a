// The simulator over topics: clock, sensors, transforms and truth of one world, in real time.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <set>
#include <string>

#include "field_fusion/TruthBodies.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

constexpr double kPatience = 60.0;  // s of wall time: Embree first builds the world

TEST(Sim, EverySensorSpeaksAndItsStampIsOfTheClock) {
  Received<sensor_msgs::LaserScan> scan("scan/scan");
  Received<sensor_msgs::Image> depth("depth/depth/image_raw");
  Received<sensor_msgs::Imu> imu("imu/data");
  Received<nav_msgs::Odometry> odometry("odom");
  ASSERT_TRUE(
      spinUntil([&] { return scan.last && depth.last && imu.last && odometry.last; }, [] {}, kPatience));
  EXPECT_EQ(scan.last->header.frame_id, "scan");
  EXPECT_EQ(depth.last->header.frame_id, "depth_optical");
  EXPECT_EQ(odometry.last->child_frame_id, "base");
  EXPECT_GT(scan.last->header.stamp, ros::Time(1000.0) - ros::Duration(0.001));
  // on /clock, no message comes from the future
  ASSERT_TRUE(spinUntil([&] { return ros::Time::now() > imu.last->header.stamp; }, [] {}, kPatience));
}

TEST(Sim, ClockRunsOn) {
  Received<rosgraph_msgs::Clock> clock("/clock");
  ASSERT_TRUE(spinUntil([&] { return clock.last != nullptr; }, [] {}, kPatience));
  const ros::Time first = clock.last->clock;
  EXPECT_TRUE(spinUntil([&] { return clock.last->clock - first >= ros::Duration(0.5); }, [] {}, kPatience));
}

TEST(Sim, TransformsAreKnownToWhoComesLate) {
  Received<tf2_msgs::TFMessage> fixed("/tf_static"), moving("/tf");
  ASSERT_TRUE(spinUntil([&] { return fixed.last && moving.last; }, [] {}, kPatience));
  std::set<std::string> children;
  for (const auto& t : fixed.last->transforms) children.insert(t.child_frame_id);
  EXPECT_EQ(children, (std::set<std::string>{"scan", "depth", "depth_optical", "imu"}));
  EXPECT_EQ(moving.last->transforms.at(0).header.frame_id, "odom");
  EXPECT_EQ(moving.last->transforms.at(0).child_frame_id, "base");
}

TEST(Sim, TruthOfTheBodiesIsBeside) {
  Received<TruthBodies> bodies("truth/bodies");
  ASSERT_TRUE(spinUntil([&] { return bodies.last != nullptr; }, [] {}, kPatience));
  EXPECT_EQ(bodies.last->header.frame_id, "world");
  EXPECT_GE(bodies.last->bodies.size(), 8u);  // the obstacles of paper 004's Fig. 15
}

}  // namespace
}  // namespace field_fusion::test
