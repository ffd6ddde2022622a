// Clouds and odometry over topics. The LiDAR stands at (0.2, 0, 0.5) of `base` (deskew_cloud.test).
#include <gtest/gtest.h>

#include "field_fusion/core/scan/deskew.h"
#include "field_fusion/ros/cloud_message.h"
#include "support/motion_messages.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

class DeskewCloudStage : public testing::Test {
 protected:
  void SetUp() override {
    lidar_.T_base_scanner.translation() << 0.2, 0.0, 0.5;
    ASSERT_TRUE(spinUntil([this] { return odom_.connected() && in_.connected() && out_.connected(); }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  /// One row of a LiDAR, whose last point is measured at the stamp.
  CloudMessage cloudAt(double stamp) const {
    CloudMessage out;
    out.header = headerAt(stamp, "lidar");
    const double begin = stamp - lidar_.sweep().end;
    core::scanPoints(lidar_.scan({}, turning_, begin), -lidar_.sweep().end, lidar_.timeIncrement(),
                     out.points);
    return out;
  }
  void sendOdometry(double begin, double end) const {
    everyHundredth(begin, end, [this](double stamp) { odom_.send(odometryAt(turning_, stamp)); });
  }
  bool came(const CloudMessage& sent) {
    return spinUntil([&] { return out_.last && out_.last->header.stamp == sent.header.stamp; });
  }
  /// Sends until a cloud comes deskewed.
  bool works() {
    const auto deskewed = [this] {
      return out_.last->points.size() == 1600 && out_.last->points[5].time == 0.f;
    };
    return askUntil([&] { return out_.last && out_.last->header.stamp == ros::Time(now_) && deskewed(); },
                    [this] {
                      now_ += 1.0;
                      sendOdometry(now_ - 0.2, now_ + 0.1);
                      in_.send(cloudAt(now_));
                    });
  }

  double now_ = 0.0;
  Scanner lidar_;
  Motion turning_ = steady({0, 0, 0}, {0, 0, 1}, core::radians(90.0));
  Sender<nav_msgs::Odometry> odom_{"odom"};
  Sender<CloudMessage> in_{"points"};
  Received<CloudMessage> out_{"points_deskewed"};
  Diagnostics diagnostics_;
};

TEST_F(DeskewCloudStage, EveryPointIsWhereItWasAtTheEndAndThatIsTheStamp) {
  ASSERT_TRUE(works());
  ASSERT_EQ(out_.last->points.size(), 1600u);
  EXPECT_EQ(out_.last->header.frame_id, "lidar");
  EXPECT_LT(offTheWalls(out_.last->points, lidar_.pose(turning_, now_)), 1e-3);
}

TEST_F(DeskewCloudStage, PointsWithoutTimesComeRawAndAreNamed) {
  ASSERT_TRUE(works());
  auto sent = cloudAt(now_ += 1.0);
  for (auto& p : sent.points) p.time = core::kNaN;
  in_.send(sent);
  ASSERT_TRUE(came(sent));
  for (std::size_t i = 0; i < sent.points.size(); ++i)
    EXPECT_EQ(out_.last->points[i].position(), sent.points[i].position());
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics_.says("deskew_cloud", "passed on raw, its points have no times");
  }));
}

TEST_F(DeskewCloudStage, WithoutOdometryItComesRawWithItsTimes) {
  ASSERT_TRUE(works());
  const auto sent = cloudAt(now_ += 5.0);
  in_.send(sent);
  ASSERT_TRUE(came(sent));
  EXPECT_EQ(out_.last->points[100].time, sent.points[100].time);
  EXPECT_TRUE(works());
}

TEST_F(DeskewCloudStage, GapsDamagedPosesAndTwoCloudsOfOneStampAreNamed) {
  ASSERT_TRUE(works());
  const auto sent = cloudAt(now_ += 5.0);
  sendOdometry(now_ + 0.2, now_ + 0.4);
  auto nan = odometryAt(turning_, now_ + 0.41);
  nan.pose.pose.orientation.w = NAN;
  odom_.send(nan);
  in_.send(sent);
  in_.send(sent);
  ASSERT_TRUE(came(sent));
  EXPECT_EQ(out_.last->points[100].time, sent.points[100].time);
  for (const std::string key : {"clouds passed on raw, its motion has a gap above max_gap",
                                "odom: dropped, pose damaged", "points: dropped, stamp out of order"})
    EXPECT_TRUE(spinUntil([&] { return !diagnostics_.value("deskew_cloud", key).empty(); })) << key;
  EXPECT_TRUE(works());
}

TEST_F(DeskewCloudStage, EmptyCloudAndABagThatLoops) {
  ASSERT_TRUE(works());
  CloudMessage empty;
  empty.header = headerAt(now_ += 1.0, "lidar");
  in_.send(empty);
  ASSERT_TRUE(came(empty));
  EXPECT_TRUE(out_.last->points.empty());
  now_ -= 100.0;
  out_.last.reset();
  EXPECT_TRUE(works());
}

}  // namespace
}  // namespace field_fusion::test
