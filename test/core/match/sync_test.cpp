#include "field_fusion/core/match/sync.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/sync_probe.h"

namespace field_fusion::core {
namespace {

class SyncTest : public SyncProbe {};

TEST_F(SyncTest, NothingGivesNothing) {
  EXPECT_EQ(out(100.0), Stamps{});
  EXPECT_TRUE(sync().idle());
}

TEST_F(SyncTest, EqualStampsPairAtOnceInEitherOrder) {
  EXPECT_TRUE(clusters(10.0, 0.0));
  EXPECT_EQ(out(0.1), Stamps{});
  EXPECT_TRUE(detections(10.0, 0.1));
  EXPECT_EQ(out(0.1), Stamps{10.0});
  detections(10.1, 0.2);
  clusters(10.1, 0.3);
  EXPECT_EQ(out(0.3), Stamps{10.1});
  EXPECT_EQ(sync().counts().pairs, 2u);
}

TEST_F(SyncTest, IntervalIsInclusiveAndBeyondItNothingPairs) {
  params_.max_interval = 0.125;
  clusters(10.0, 0.0), detections(10.125, 0.0);
  EXPECT_EQ(out(0.0), Stamps{10.0});
  clusters(11.0, 0.1), detections(11.1251, 0.1);
  EXPECT_EQ(out(0.1), Stamps{-11.0});
}

TEST_F(SyncTest, WithoutKnownSpacingALaterMessageDecides) {
  detections(9.99, 0.0);
  clusters(10.0, 0.0);
  EXPECT_EQ(out(0.0), Stamps{});
  detections(10.03, 0.03);
  EXPECT_EQ(frames(0.03).at(0).detections, Stamps{9.99});
}

TEST_F(SyncTest, KnownSpacingDecidesBeforeALaterMessage) {
  learn();                                   // the last at 10 - 1/30
  const double limit = 0.5 / 30.0 + 0.0025;  // half of the spacing, and of a tenth of max_interval
  clusters(10.0 - 1 / 30.0 + limit - 1e-6, 0.0);
  EXPECT_EQ(out(0.0).size(), 1u);
  clusters(10.0 - 1 / 30.0 + limit + 1e-6, 0.0);  // the next may be nearer
  EXPECT_EQ(out(0.0), Stamps{});
}

TEST_F(SyncTest, SlowCameraIsNotWaitedForWhereItsNextIsTooFarOff) {
  for (int i = 0; i < 6; ++i) detections(8.0 + 0.3 * i, 0.0);  // the last at 9.5, the next not before 9.8
  clusters(9.7, 0.0);
  EXPECT_EQ(out(0.0), Stamps{-9.7});
  clusters(9.77, 0.0);
  EXPECT_EQ(out(0.0), Stamps{});
}

TEST_F(SyncTest, ClustersGoOnAloneAfterTheTimeout) {
  detections(9.9, 0.3);
  clusters(10.0, 0.4);
  EXPECT_EQ(out(0.79), Stamps{});
  EXPECT_EQ(out(0.91), Stamps{-10.0});
  EXPECT_EQ(sync().counts().alone, 1u);
}

TEST_F(SyncTest, NobodyWaitsForASilentCameraAndItsReturnIsTaken) {
  EXPECT_TRUE(clusters(10.0, 0.0));
  EXPECT_EQ(out(0.49), Stamps{});
  EXPECT_EQ(out(0.5), Stamps{-10.0});
  EXPECT_FALSE(clusters(10.7, 0.7)) << "no second revision";
  detections(10.8, 0.8);
  EXPECT_TRUE(clusters(10.8, 0.8));
  EXPECT_EQ(out(0.8), Stamps{10.8});
}

/// Clusters at 1 Hz, each 0.2 s on its way, and a camera at 10 Hz.
TEST_F(SyncTest, LidarSlowerThanTheTimeoutHasOneLastWordOfEachInstantAndItsEndIsSeen) {
  std::vector<SyncOut> seen;
  const auto run = [&](int from, int to, bool lidar) {
    for (int i = from; i < to; ++i) {
      detections(100.0 + 0.1 * i, 0.1 * i);
      if (lidar && i % 10 == 2) clusters(100.0 + 0.1 * (i - 2), 0.1 * i);
      for (const SyncOut& frame : frames(0.1 * i + 0.01)) seen.push_back(frame);
    }
  };
  run(0, 60, true);  // until its period is known
  seen.clear();
  run(60, 200, true);
  ASSERT_EQ(seen.size(), 14u);
  for (const SyncOut& frame : seen) {
    EXPECT_TRUE(frame.clusters);
    EXPECT_NEAR(frame.detections[0], frame.stamp, 1e-9);
  }
  seen.clear();
  run(200, 240, false);  // the last clusters came at 19.2 s
  ASSERT_FALSE(seen.empty()) << "nobody waits for a LiDAR that ended";
  for (const SyncOut& frame : seen) EXPECT_FALSE(frame.clusters);
  EXPECT_GE(seen.size(), 30u) << "what came meanwhile is not lost";
}

/// Both at 1 Hz with equal stamps, the boxes 0.01 s after their clusters.
TEST_F(SyncTest, SensorsSlowerThanTheTimeoutPairAndTheCamerasEndIsSeen) {
  std::vector<double> stamps;
  for (int i = 0; i < 20; ++i) {
    clusters(100.0 + i, i);
    for (const double stamp : out(i)) stamps.push_back(stamp);
    detections(100.0 + i, i + 0.01);
    for (const double stamp : out(i + 0.01)) stamps.push_back(stamp);
  }
  ASSERT_GE(stamps.size(), 14u);
  EXPECT_TRUE(std::all_of(stamps.end() - 14, stamps.end(), [](double s) { return s > 0; }));
  EXPECT_EQ(stamps.back(), 119.0);
  EXPECT_TRUE(clusters(120.0, 20.0));
  EXPECT_EQ(out(20.49), Stamps{});
  EXPECT_EQ(out(20.5), Stamps{-120.0}) << "nobody waits longer than the timeout";
  EXPECT_FALSE(clusters(121.0, 21.0)) << "silent for 1.99 s";
}

TEST_F(SyncTest, FramesKeepTheOrderOfClusters) {
  clusters(10.0, 0.0), clusters(10.1, 0.1), clusters(10.2, 0.2);
  detections(10.2, 0.3);
  EXPECT_EQ(out(0.3), (Stamps{-10.0, -10.1, 10.2}));
}

TEST_F(SyncTest, LateDetectionsAreToldAndGoNowhere) {
  clusters(10.0, 0.0);
  EXPECT_EQ(out(0.6), Stamps{-10.0});
  EXPECT_FALSE(detections(10.0, 0.7));
  clusters(10.2, 0.8);
  EXPECT_TRUE(detections(10.1, 0.8));
  EXPECT_EQ(out(0.8), Stamps{});
  EXPECT_EQ(sync().counts().late, 1u);
}

TEST_F(SyncTest, CameraLateByOneSecondPairsOnlyWithThePatience) {
  for (const double timeout : {0.5, 1.5}) {
    params_.partner_timeout = timeout;
    sync_.emplace(params_);
    std::size_t paired = 0;
    for (int i = 0; i < 100; ++i) {  // 10 Hz
      const double now = 0.1 * i;
      clusters(100.0 + now, now);
      if (i >= 10) detections(99.0 + now, now);
      for (const double stamp : out(now)) paired += stamp > 0;
    }
    EXPECT_EQ(paired, timeout < 1.0 ? 0u : 90u);
    EXPECT_EQ(sync().counts().late > 80, timeout < 1.0);
  }
}

/// 10 Hz each, at the same instants; the camera's clock is 80 ms ahead.
TEST_F(SyncTest, ConstantOffsetOfTheClocksPairsWrongUnlessItIsGiven) {
  for (const double given : {0.0, -0.08}) {
    params_.time_offset = given;
    sync_.emplace(params_);
    std::vector<double> errors;
    for (int i = 0; i < 50; ++i) {
      clusters(10.0 + 0.1 * i, 0.1 * i);
      detections(10.08 + 0.1 * i, 0.1 * i);
      for (const SyncOut& frame : frames(0.1 * i)) errors.push_back(frame.detections[0] - 0.08 - frame.stamp);
    }
    ASSERT_GT(errors.size(), 45u);
    for (std::size_t i = 1; i < errors.size(); ++i)
      EXPECT_NEAR(errors[i], given == 0.0 ? -0.1 : 0.0, 1e-9) << "seconds between what is paired";
  }
}

TEST_F(SyncTest, OffsetIsTheStampsDifferenceAfterCorrection) {
  params_.time_offset = -0.08;
  clusters(10.0, 0.0);
  detections(10.3, 0.0);
  const auto frame = sync().next(0.0);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->answers[0].detections, nullptr);
  EXPECT_NEAR(frame->answers[0].offset, 0.22, 1e-9) << "told also where it is too far";
}

TEST_F(SyncTest, StampsThatGoBackStartAnew) {
  clusters(100.0, 0.0);
  detections(100.2, 0.0);
  clusters(5.0, 0.1);
  detections(5.0, 0.1);
  EXPECT_EQ(out(0.1), Stamps{5.0});
}

TEST_F(SyncTest, FullQueueSendsTheOldestOnAndCounts) {
  params_.partner_timeout = 3600.0;
  for (int i = 0; i < 65; ++i) clusters(10.0 + 0.1 * i, 0.0);
  EXPECT_EQ(out(0.0), Stamps{-10.0});
  EXPECT_EQ(sync().counts().dropped, 1u);
  sync().reset();
  for (int i = 0; i < 65; ++i) detections(10.0 + 0.1 * i, 0.0);
  EXPECT_EQ(sync().counts().dropped, 2u);
}

TEST_F(SyncTest, ResetForgetsWhatWaits) {
  clusters(10.0, 0.0);
  sync().reset();
  EXPECT_TRUE(sync().idle());
  detections(10.0, 0.1);
  EXPECT_EQ(out(0.2), Stamps{});
}

/// The stated rule, slowly, on jittered stamps and arrivals.
TEST_F(SyncTest, NoOtherIsNearerByMoreThanATenthOfTheInterval) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004), latency(0.0, 0.08);
  struct Arrival {
    double now, stamp;
    bool lidar;
  };
  std::vector<Arrival> arrivals;
  std::vector<double> camera;
  double last[2] = {0.0, 0.0};
  for (int i = 0; i < 600; ++i) {
    for (int lidar = 0; lidar < (i % 3 == 0 ? 2 : 1); ++lidar) {
      const double stamp = 10.0 + i / 30.0 + jitter(random);
      last[lidar] = std::max(last[lidar], stamp + latency(random));  // a topic keeps its order
      arrivals.push_back({last[lidar], stamp, lidar == 1});
      if (lidar == 0) camera.push_back(stamp);
    }
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.now < b.now; });
  std::size_t nearest = 0, total = 0;
  for (const Arrival& a : arrivals) {
    a.lidar ? clusters(a.stamp, a.now) : detections(a.stamp, a.now);
    for (const SyncOut& frame : frames(a.now)) {
      const double best = *std::min_element(camera.begin(), camera.end(), [&](double x, double y) {
        return std::abs(x - frame.stamp) < std::abs(y - frame.stamp);
      });
      ASSERT_EQ(frame.detections.size(), 1u);
      ++total;
      nearest += std::abs(frame.detections[0] - frame.stamp) <= std::abs(best - frame.stamp) + 0.005;
    }
  }
  EXPECT_GE(total, 195u);
  EXPECT_GE(nearest, total - 2) << "the spacing is learnt, not known";
}

TEST(SyncParams, NamesAreCheckedAndDefaultsAreValid) {
  SyncParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
  EXPECT_EQ(params.topicOf(0), "detections");
  params.cameras = {"a", "a"};
  EXPECT_EQ(declarationOf(params).faults().size(), 1u);
  params.cameras = {"a", "b"};
  params.time_offsets = {{"c", 0.1}};
  EXPECT_EQ(declarationOf(params).faults().size(), 1u);
  EXPECT_EQ(params.topicOf(1), "b/detections");
}

TEST(Spacing, IsTheLeastOfTheLastGaps) {
  Spacing spacing;
  for (int i = 0; i < 3; ++i) spacing.add(0.1);
  EXPECT_EQ(spacing.least(), 0.0) << "too few";
  spacing.add(0.05);
  EXPECT_EQ(spacing.least(), 0.05);
  for (int i = 0; i < 16; ++i) spacing.add(0.2);
  EXPECT_EQ(spacing.least(), 0.2);
}

}  // namespace
}  // namespace field_fusion::core
