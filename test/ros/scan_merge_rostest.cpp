// Scans over topics: a scanner 0.6 m over the ground, a made-up one at 0.1 m, on a body that walks.
#include <gtest/gtest.h>

#include "field_fusion/ros/scan_message.h"
#include "support/frames.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

class ScanMergeStage : public testing::Test {
 protected:
  void SetUp() override {
    frames_.sendStatic("base", "laser", core::Transform(Eigen::Translation3d(0, 0, 0.6)));
    frames_.sendStatic("base", "depth", core::Transform(Eigen::Translation3d(0, 0, 0.1)));
    ASSERT_TRUE(spinUntil([this] { return scan_.connected() && depth_.connected() && out_.connected(); }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  /// 360 beams of 1 degree from -180 on.
  static sensor_msgs::LaserScan scanAt(double stamp, const std::string& frame, float ahead, float rest) {
    core::Scan scan;
    scan.angle_min = core::radians(-180.0), scan.angle_increment = core::radians(1.0);
    scan.range_min = 0.1, scan.range_max = 25.0;
    scan.ranges.assign(360, rest);
    scan.ranges[180] = ahead;
    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp.fromSec(stamp);
    return *scanMessage(header, scan);
  }
  /// A new instant; the body's pose is known 0.2 s about it.
  void next() {
    now_ += 1.0;
    for (int i = -20; i <= 20; ++i) frames_.send(now_ + 0.01 * i, "odom", "base", pose(now_ + 0.01 * i));
  }
  core::Transform pose(double time) const {
    core::Transform out(Eigen::Translation3d(speed_ * (time - now_), 0, 0));
    out.rotate(Eigen::AngleAxisd(pitch_, Eigen::Vector3d::UnitY()));
    return out;
  }
  bool came() {
    return spinUntil([this] { return out_.last && out_.last->header.stamp == ros::Time(now_); });
  }
  bool works() {
    return askUntil([this] { return out_.last && out_.last->header.stamp == ros::Time(now_); },
                    [this] { next(), scan_.send(scanAt(now_, "laser", 5.f, core::kFree)); });
  }
  bool warns(const std::string& text) {
    return spinUntil([&] { return diagnostics_.says("scan_merge", text); });
  }

  double now_ = 0.0, speed_ = 0.0, pitch_ = 0.0;
  Frames frames_;
  Sender<sensor_msgs::LaserScan> scan_{"scan"}, depth_{"depth_scan"};
  Received<sensor_msgs::LaserScan> out_{"scan_merged"};
  Diagnostics diagnostics_;
};

TEST_F(ScanMergeStage, MissingPartnerIsDoneWithoutAndNamed) {
  ASSERT_TRUE(works());
  EXPECT_EQ(out_.last->header.frame_id, "scan_plane");
  EXPECT_FLOAT_EQ(out_.last->ranges[180], 5.f);
  EXPECT_EQ(out_.last->ranges[0], core::kFree);
  EXPECT_TRUE(warns("merged without depth_scan"));
}

TEST_F(ScanMergeStage, NearestOfBothAndThePartnerAtItsOwnStamp) {
  ASSERT_TRUE(works());
  speed_ = 1.0;
  next();
  depth_.send(scanAt(now_ - 0.1, "depth", 2.f, core::kNaN));
  ASSERT_TRUE(spinUntil([&] { return out_.last->header.stamp == ros::Time(now_ - 0.1); }))
      << "the other is silent";
  EXPECT_FLOAT_EQ(out_.last->ranges[180], 2.f);
  scan_.send(scanAt(now_, "laser", 5.f, 6.f));
  ASSERT_TRUE(came());
  EXPECT_NEAR(out_.last->ranges[180], 1.9, 1e-3) << "it walked 0.1 m since";
  EXPECT_FLOAT_EQ(out_.last->ranges[90], 6.f);
}

TEST_F(ScanMergeStage, PartnerThatIsAheadDoesNotTakeOver) {
  // a scan comes when its last beam is measured: until then others are ahead of the last one
  ASSERT_TRUE(works());
  now_ += 0.3;
  for (int i = -20; i <= 20; ++i) frames_.send(now_ + 0.01 * i, "odom", "base", pose(now_));
  depth_.send(scanAt(now_, "depth", 2.f, core::kNaN));
  scan_.send(scanAt(now_ -= 0.15, "laser", 5.f, 6.f));
  ASSERT_TRUE(came());
  EXPECT_FLOAT_EQ(out_.last->ranges[90], 6.f);
}

TEST_F(ScanMergeStage, AScannerThatNoTransformPlacesDoesNotSilenceTheOthers) {
  ASSERT_TRUE(works());
  next();
  scan_.send(scanAt(now_, "lost", 5.f, 6.f));
  ASSERT_TRUE(spinUntil([&] { return !diagnostics_.value("scan_merge", "scan: dropped, no transform").empty(); }));
  now_ += 0.1;
  depth_.send(scanAt(now_, "depth", 2.f, core::kFree));
  ASSERT_TRUE(came());
  EXPECT_FLOAT_EQ(out_.last->ranges[180], 2.f);
}

TEST_F(ScanMergeStage, PitchIsTakenOutOfTheProjection) {
  ASSERT_TRUE(works());
  pitch_ = core::radians(-5.0);  // looks up
  next();
  scan_.send(scanAt(now_, "laser", 5.f, core::kNaN));
  ASSERT_TRUE(came());
  // along the beam 5 cos 5, and the scanner itself leans back by 0.6 sin 5
  EXPECT_NEAR(out_.last->ranges[180], 5.0 * std::cos(pitch_) + 0.6 * std::sin(pitch_), 1e-3);
}

TEST_F(ScanMergeStage, DamagedScanIsDroppedAndABagMayLoop) {
  ASSERT_TRUE(works());
  next();
  auto damaged = scanAt(now_, "laser", 5.f, 6.f);
  damaged.range_max = -1.f;
  scan_.send(damaged);
  EXPECT_TRUE(
      spinUntil([&] { return !diagnostics_.value("scan_merge", "scan: dropped, scan damaged").empty(); }));
  now_ -= 60.0;
  EXPECT_TRUE(works());
}

TEST_F(ScanMergeStage, AStampFromTheFutureIsToldAndSendsNoTransform) {
  ASSERT_TRUE(works());
  const double after = now_;
  now_ = ros::Time::now().toSec() + 1000.0;
  next();
  scan_.send(scanAt(now_, "laser", 5.f, core::kFree));
  EXPECT_TRUE(warns("stamp is ahead of the clock: by"));
  EXPECT_FALSE(frames_.knows(now_, "base", "scan_plane"));
  now_ = after;
  EXPECT_TRUE(works());
}

}  // namespace
}  // namespace field_fusion::test
