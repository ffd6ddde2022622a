// The filter over topics, and with it what every stage does: faults, time, parameters, lazy subscription.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstring>

#include "field_fusion/ros/cloud_message.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

CloudMessage cloudAt(double stamp, const core::Cloud& points = {{1.f, 0.f, 0.f}}) {
  CloudMessage cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp.fromSec(stamp);
  cloud.points = points;
  return cloud;
}

class FilterStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([this] { return in_.connected() && out_.connected(); }));
    // one test's clock must not look like the next one's time jump
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  double next() { return now_ += 0.1; }
  /// Sends clouds until one comes out again; the stage is then known to work.
  bool passes() {
    const int before = out_.count;
    return spinUntil([&] { return out_.count > before; }, [this] { in_.send(cloudAt(next())); });
  }
  std::string dropped(const std::string& kind) const {
    return diagnostics_.value("filter", "points: dropped, " + kind);
  }
  bool reports(
      const std::string& kind, const std::function<void()>& step = [] {}) {
    return spinUntil([&] { return !dropped(kind).empty(); }, step);
  }

  double now_ = 0.0;
  Received<CloudMessage> out_{"points_filtered"};
  Sender<CloudMessage> in_{"points"};
  Sender<sensor_msgs::PointCloud2> raw_{"points"};
  Diagnostics diagnostics_;
};

TEST_F(FilterStage, KeepsStampFrameAndTheFieldsOfThePointsThatPass) {
  const core::Point good{1.f, 2.f, 3.f, 4.f, 0.05f, 6};
  const core::Point nan{core::kNaN, 0.f, 0.f}, far{11.f, 0.f, 0.f};
  const auto sent = cloudAt(next(), {good, nan, far});
  ASSERT_TRUE(spinUntil([&] { return out_.last && out_.last->header.stamp == sent.header.stamp; },
                        [&] { in_.send(sent); }));
  EXPECT_EQ(out_.last->header.frame_id, "lidar");
  ASSERT_EQ(out_.last->points.size(), 1u);
  EXPECT_EQ(std::memcmp(&out_.last->points[0], &good, sizeof good), 0);
}

TEST_F(FilterStage, EmptyCloudGivesAnEmptyCloud) {
  ASSERT_TRUE(passes());
  const auto sent = cloudAt(next(), {});
  in_.send(sent);
  ASSERT_TRUE(spinUntil([&] { return out_.last->header.stamp == sent.header.stamp; }));
  EXPECT_TRUE(out_.last->points.empty());
}

TEST_F(FilterStage, CloudWithoutRingAndTimePassesAndSaysThatTheyAreUnknown) {
  ASSERT_TRUE(passes());
  sensor_msgs::PointCloud2 plain;
  sensor_msgs::PointCloud2Modifier(plain).setPointCloud2FieldsByString(1, "xyz");
  sensor_msgs::PointCloud2Modifier(plain).resize(1);
  *sensor_msgs::PointCloud2Iterator<float>(plain, "x") = 2.f;
  *sensor_msgs::PointCloud2Iterator<float>(plain, "y") = 0.f;
  *sensor_msgs::PointCloud2Iterator<float>(plain, "z") = 0.f;
  plain.header.stamp.fromSec(next());
  raw_.send(plain);
  ASSERT_TRUE(spinUntil([&] { return out_.last->header.stamp == plain.header.stamp; }));
  ASSERT_EQ(out_.last->points.size(), 1u);
  EXPECT_EQ(out_.last->points[0].ring, core::kUnknownRing);
  EXPECT_TRUE(std::isnan(out_.last->points[0].time));
}

TEST_F(FilterStage, DamagedCloudIsDroppedNamedAndTheNextOneTaken) {
  ASSERT_TRUE(passes());
  sensor_msgs::PointCloud2 damaged;
  damaged.header.stamp.fromSec(next());
  damaged.width = damaged.height = 0xffffffff;
  raw_.send(damaged);
  EXPECT_TRUE(reports("cloud sizes disagree"));
  EXPECT_EQ(diagnostics_.of("filter")->level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_TRUE(passes());
}

TEST_F(FilterStage, FaultDoesNotHideTheSilenceAfterIt) {
  ASSERT_TRUE(passes());
  in_.send(cloudAt(0.0));
  const auto dropped = [&] { return diagnostics_.says("filter", "points dropped, stamp is zero"); };
  const auto silent = [&] { return diagnostics_.says("filter", "nothing new on points"); };
  EXPECT_TRUE(spinUntil([&] { return dropped() && silent(); },
                        [&] {
                          if (silent()) in_.send(cloudAt(0.0));  // slow: the fault was forgotten meanwhile
                        }));
  EXPECT_TRUE(passes());
}

TEST_F(FilterStage, StampZeroIsDropped) {
  ASSERT_TRUE(passes());
  in_.send(cloudAt(0.0));
  EXPECT_TRUE(reports("stamp is zero"));
  EXPECT_TRUE(passes());
}

TEST_F(FilterStage, OutOfOrderIsDroppedAndStampsRise) {
  ASSERT_TRUE(passes());
  const auto newest = out_.last->header.stamp;
  in_.send(cloudAt(newest.toSec() - 0.5));
  EXPECT_TRUE(reports("stamp out of order"));
  EXPECT_EQ(out_.last->header.stamp, newest);
  EXPECT_TRUE(passes());
}

TEST_F(FilterStage, LoopingBagIsATimeJumpAndGoesOn) {
  ASSERT_TRUE(passes());
  const auto before = diagnostics_.value("filter", "time jumps");
  now_ -= 60.0;
  ASSERT_TRUE(passes());
  EXPECT_LT(out_.last->header.stamp.toSec(), now_ + 1.0);
  EXPECT_TRUE(spinUntil([&] { return diagnostics_.value("filter", "time jumps") != before; }));
}

TEST_F(FilterStage, MillionPointsPass) {
  ASSERT_TRUE(passes());
  const auto sent = cloudAt(next(), core::Cloud(1'000'000, {1.f, 1.f, 1.f}));
  in_.send(sent);
  ASSERT_TRUE(spinUntil([&] { return out_.last->header.stamp == sent.header.stamp; }));
  EXPECT_EQ(out_.last->points.size(), sent.points.size());
}

TEST_F(FilterStage, LiveParameterIsTakenStoredAndAnImpossibleOneRefused) {
  const auto set = [](double max_range) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.doubles.resize(1);
    call.request.config.doubles[0].name = "max_range";
    call.request.config.doubles[0].value = max_range;
    EXPECT_TRUE(ros::service::call("filter/set_parameters", call));
    for (const auto& entry : call.response.config.doubles)
      if (entry.name == "max_range") return entry.value;
    return -1.0;
  };
  const auto stored = [] { return ros::param::param("filter/max_range", -1.0); };
  EXPECT_EQ(set(20.0), 20.0);
  EXPECT_EQ(stored(), 20.0);
  EXPECT_EQ(set(-5.0), 20.0) << "outside its range";
  EXPECT_EQ(stored(), 20.0);
  const auto sent = cloudAt(next(), {{15.f, 0.f, 0.f}});
  in_.send(sent);
  ASSERT_TRUE(spinUntil([&] { return out_.last && out_.last->header.stamp == sent.header.stamp; }));
  EXPECT_EQ(out_.last->points.size(), 1u) << "15 m lies within the new range";
  EXPECT_EQ(set(10.0), 10.0);
}

TEST_F(FilterStage, LatencyAndCountersAreInDiagnostics) {
  ASSERT_TRUE(passes());
  ASSERT_TRUE(spinUntil(
      [&] { return !diagnostics_.value("filter", "points: latency p50 p95 p99 max [ms]").empty(); }));
  EXPECT_GE(std::stoi(diagnostics_.value("filter", "points: received")),
            std::stoi(diagnostics_.value("filter", "points: processed")));
}

TEST(LazyStage, SubscribesOnlyWhileSomebodyListens) {
  Sender<CloudMessage> in("points");
  Diagnostics diagnostics;
  const auto idle = [&] {
    return diagnostics.of("filter") && diagnostics.of("filter")->message.find("IDLE") == 0;
  };
  ASSERT_TRUE(spinUntil(idle));
  EXPECT_FALSE(in.connected());
  for (int visit = 0; visit < 3; ++visit) {
    Received<CloudMessage> out("points_filtered");
    EXPECT_TRUE(spinUntil([&] { return in.connected(); })) << "visit " << visit;
    ros::Time stamp(100.0 + visit, 0);
    EXPECT_TRUE(spinUntil([&] { return out.last != nullptr; },
                          [&] { in.send(cloudAt((stamp += ros::Duration(0.1)).toSec())); }));
    out.leave();
    EXPECT_TRUE(spinUntil([&] { return !in.connected(); })) << "visit " << visit;
  }
}

}  // namespace
}  // namespace field_fusion::test
