// Scans and what tells their motion over topics. The scanner stands at (0.2, 0, 0.5) of `base`
// (deskew_scan.test).
#include <gtest/gtest.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "field_fusion/ros/cloud_message.h"
#include "support/motion_messages.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

const double kTurnRate = core::radians(90.0);

class DeskewScanStage : public testing::Test {
 protected:
  void SetUp() override {
    scanner_.T_base_scanner.translation() << 0.2, 0.0, 0.5;
    ASSERT_TRUE(spinUntil([this] {
      return odom_.connected() && imu_.connected() && scan_.connected() && out_.connected() &&
             points_.connected() && by_imu_.connected() && by_vicp_.connected();
    }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  sensor_msgs::LaserScan scanAt(double stamp, const std::string& frame = "laser") const {
    return *scanMessage(headerAt(stamp, frame), scanner_.scan({}, turning_, stamp));
  }
  void sendOdometry(double begin, double end) const {
    everyHundredth(begin, end, [this](double stamp) { odom_.send(odometryAt(turning_, stamp)); });
  }
  bool came(const sensor_msgs::LaserScan& sent) {
    return spinUntil([&] {
      const auto is = [&](const auto& out) {
        return out.last && out.last->header.stamp == sent.header.stamp;
      };
      return is(out_) && is(points_);
    });
  }
  /// A scan comes out deskewed; odometry until 0.3 s after it is then known.
  bool works() {
    return askUntil([this] { return out_.last && out_.last->header.stamp == ros::Time(now_) && deskewed(); },
                    [this] {
                      now_ += 1.0;
                      sendOdometry(now_ - 0.1, now_ + 0.3);
                      scan_.send(scanAt(now_));
                    });
  }
  bool deskewed() const { return out_.last->time_increment == 0.f; }
  bool warns(const std::string& text) {
    return spinUntil([&] {
      return diagnostics_.says("deskew_scan", text) &&
             diagnostics_.of("deskew_scan")->level == diagnostic_msgs::DiagnosticStatus::WARN;
    });
  }
  bool counts(const std::string& key) {
    return spinUntil([&] { return !diagnostics_.value("deskew_scan", key).empty(); });
  }
  core::Transform T_world_scanner(double stamp) const { return scanner_.pose(turning_, stamp); }

  double now_ = 0.0;
  Scanner scanner_;
  Motion turning_ = steady({0, 0, 0}, {0, 0, 1}, kTurnRate);
  Sender<nav_msgs::Odometry> odom_{"odom"};
  Sender<sensor_msgs::Imu> imu_{"imu"};
  Sender<sensor_msgs::LaserScan> scan_{"scan"};
  Received<sensor_msgs::LaserScan> out_{"scan_deskewed"}, by_vicp_{"by_vicp/scan_deskewed"};
  Received<CloudMessage> points_{"scan_points"}, by_imu_{"by_imu/scan_points"};
  Diagnostics diagnostics_;
};

TEST_F(DeskewScanStage, EveryBeamIsWhereItWasAtTheStamp) {
  ASSERT_TRUE(works());
  EXPECT_EQ(out_.last->header.frame_id, "laser");
  ASSERT_EQ(points_.last->points.size(), 1600u);
  const double stamp = points_.last->header.stamp.toSec();
  EXPECT_LT(offTheWalls(points_.last->points, T_world_scanner(stamp)), 1e-3);
  EXPECT_EQ(out_.last->ranges.size(), 1600u);
  EXPECT_EQ(out_.last->range_min, 0.f);
}

TEST_F(DeskewScanStage, OdometryBeforeOrAfterTheScanGivesTheSame) {
  ASSERT_TRUE(works());
  std::vector<float> ranges[2];
  for (const bool late : {false, true}) {
    const auto sent = scanAt(now_ += 4.0);  // a whole turn
    sendOdometry(now_ - 0.1, now_ + (late ? 0.03 : 0.15));
    scan_.send(sent);
    if (late) sendOdometry(now_ + 0.04, now_ + 0.15);
    ASSERT_TRUE(came(sent));
    EXPECT_TRUE(deskewed());
    ranges[late] = out_.last->ranges;
  }
  ASSERT_EQ(ranges[0].size(), ranges[1].size());
  for (std::size_t i = 0; i < ranges[0].size(); ++i) {
    if (std::isnan(ranges[0][i]) || std::isnan(ranges[1][i])) continue;  // on the border of a bin
    EXPECT_NEAR(ranges[0][i], ranges[1][i], 0.02);
  }
}

TEST_F(DeskewScanStage, WithoutOdometryItComesRawAndIsMarked) {
  ASSERT_TRUE(works());
  const auto sent = scanAt(now_ += 1.0);
  scan_.send(sent);
  ASSERT_TRUE(came(sent));
  EXPECT_FALSE(deskewed());
  EXPECT_EQ(out_.last->ranges, sent.ranges);
  EXPECT_EQ(out_.last->time_increment, sent.time_increment);
  EXPECT_FLOAT_EQ(points_.last->points[800].time, 0.05f);
  EXPECT_TRUE(warns("passed on raw, its motion ends too early"));
  EXPECT_TRUE(counts("scans passed on raw, its motion ends too early"));
  EXPECT_TRUE(works());
}

TEST_F(DeskewScanStage, GapOfTheOdometryAndALateBeginAreRaw) {
  ASSERT_TRUE(works());
  const auto gap = scanAt(now_ += 1.0);
  sendOdometry(now_ + 0.3, now_ + 0.5);
  scan_.send(gap);
  ASSERT_TRUE(came(gap));
  EXPECT_FALSE(deskewed());
  EXPECT_TRUE(counts("scans passed on raw, its motion has a gap above max_gap"));
  now_ -= 500.0;  // a loop clears the odometry: it begins after the scan
  const auto early = scanAt(now_);
  sendOdometry(now_ + 0.05, now_ + 0.2);
  scan_.send(early);
  ASSERT_TRUE(came(early));
  EXPECT_FALSE(deskewed());
  EXPECT_TRUE(counts("scans passed on raw, its motion begins too late"));
}

TEST_F(DeskewScanStage, DamagedPosesAreCountedAndDoNotEnterTheHistory) {
  ASSERT_TRUE(works());
  auto nan = odometryAt(turning_, now_ + 0.31);
  nan.pose.pose.orientation.x = NAN;
  odom_.send(nan);
  EXPECT_TRUE(counts("odom: dropped, pose damaged"));
  const auto sent = scanAt(now_ + 0.2);
  now_ += 0.2;
  sendOdometry(now_ + 0.12, now_ + 0.2);
  scan_.send(sent);
  ASSERT_TRUE(came(sent));
  EXPECT_TRUE(deskewed());
  EXPECT_TRUE(std::all_of(points_.last->points.begin(), points_.last->points.end(),
                          [](const auto& p) { return p.position().allFinite(); }));
}

TEST_F(DeskewScanStage, TwoScansOfOneStampAndADamagedOneAreDropped) {
  ASSERT_TRUE(works());
  const int before = out_.count;
  scan_.send(scanAt(out_.last->header.stamp.toSec()));
  EXPECT_TRUE(counts("scan: dropped, stamp out of order"));
  auto damaged = scanAt(now_ += 1.0);
  damaged.angle_increment = 0.f;
  scan_.send(damaged);
  EXPECT_TRUE(counts("scan: dropped, scan damaged"));
  EXPECT_EQ(out_.count, before);
  EXPECT_TRUE(works());
}

TEST_F(DeskewScanStage, LoopOfTransformsIsRawAndNamed) {
  ASSERT_TRUE(works());
  tf2_ros::StaticTransformBroadcaster broadcaster;
  std::vector<geometry_msgs::TransformStamped> loop(2);
  for (auto& transform : loop) transform.transform.rotation.w = 1.0;
  loop[0].header.frame_id = loop[1].child_frame_id = "loop_a";
  loop[1].header.frame_id = loop[0].child_frame_id = "loop_b";
  broadcaster.sendTransform(loop);
  now_ += 1.0;
  sendOdometry(now_, now_ + 0.3);
  const auto sent = scanAt(now_ + 0.1, "loop_a");
  scan_.send(sent);
  ASSERT_TRUE(came(sent));
  EXPECT_FALSE(deskewed());
  EXPECT_TRUE(warns("no transform: loop_a to base"));
  EXPECT_TRUE(works());
}

TEST_F(DeskewScanStage, BagThatLoopsGoesOn) {
  ASSERT_TRUE(works());
  now_ -= 60.0;
  EXPECT_TRUE(works());
  EXPECT_LT(out_.last->header.stamp.toSec(), now_ + 0.5);
}

TEST_F(DeskewScanStage, ScanOfOneInstantNeedsNoOdometryAndIsNamed) {
  ASSERT_TRUE(works());
  auto sent = scanAt(now_ += 1.0);
  sent.time_increment = 0.f;
  scan_.send(sent);
  ASSERT_TRUE(came(sent));
  for (std::size_t i = 0; i < sent.ranges.size(); ++i)
    EXPECT_NEAR(out_.last->ranges[i], sent.ranges[i], 1e-4);
  EXPECT_TRUE(warns("time_increment is 0"));
  EXPECT_TRUE(works());
}

TEST_F(DeskewScanStage, InertialUnitTellsTheTurn) {
  const auto came = [this] { return by_imu_.last && by_imu_.last->header.stamp == ros::Time(now_); };
  ASSERT_TRUE(askUntil(came, [this] {
    now_ += 1.0;
    everyHundredth(now_ - 0.1, now_ + 0.3, [this](double t) { imu_.send(imuAt(kTurnRate, t, "base")); });
    scan_.send(scanAt(now_));
  }));
  ASSERT_EQ(by_imu_.last->points.size(), 1600u);
  EXPECT_EQ(by_imu_.last->points[800].time, 0.f);
  EXPECT_LT(offTheWalls(by_imu_.last->points, T_world_scanner(by_imu_.last->header.stamp.toSec())), 0.02);
}

TEST_F(DeskewScanStage, VicpNeedsNothingButScansAndSendsTheInstantAsStamp) {
  turning_ = steady({0, 0, 0}, {0, 0, 1}, core::radians(20.0));
  for (int i = 0; i < 3; ++i) {
    const int before = by_vicp_.count;
    scan_.send(scanAt(now_ += 0.1));
    ASSERT_TRUE(spinUntil([&] { return by_vicp_.count > before; }));
  }
  EXPECT_EQ(by_vicp_.last->time_increment, 0.f);
  const double within = by_vicp_.last->header.stamp.toSec() / 0.1;
  EXPECT_NEAR(within - std::floor(within), 1599.0 / 1600.0, 0.01);
}

}  // namespace
}  // namespace field_fusion::test
