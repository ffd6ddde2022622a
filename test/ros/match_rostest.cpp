// Clusters and detections over topics. The camera stands 1 m ahead and 0.5 m left of the LiDAR (match.test).
#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/ObstacleArray.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

ClusterArray clustersAt(double stamp, const std::vector<std::pair<double, double>>& places) {
  ClusterArray out;
  out.header.frame_id = "lidar";
  out.header.stamp.fromSec(stamp);
  for (const auto& [x, y] : places) {
    Cluster c;
    c.id = static_cast<std::uint32_t>(out.clusters.size());
    c.centre.x = c.min.x = c.max.x = x;
    c.centre.y = c.min.y = c.max.y = y;
    c.range = static_cast<float>(std::hypot(x, y));
    c.azimuth = static_cast<float>(std::atan2(y, x));
    out.clusters.push_back(c);
  }
  return out;
}

/// Detections straight ahead of the camera, at these ranges.
ImageDetectionArray detectionsAt(double stamp, const std::vector<float>& ranges,
                                 const std::string& frame = "camera") {
  ImageDetectionArray out;
  out.header.frame_id = frame;
  out.header.stamp.fromSec(stamp);
  for (const float range : ranges) {
    ImageDetection d;
    d.id = static_cast<std::uint32_t>(out.detections.size());
    d.label = "boat";
    d.score = 0.5f;
    d.ray.z = d.ray_min.z = d.ray_max.z = 1.0;
    d.range = range;
    d.range_sigma = 0.1f;
    out.detections.push_back(d);
  }
  return out;
}

class MatchStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(
        spinUntil([this] { return clusters_.connected() && detections_.connected() && out_.connected(); }));
    // one test's clock must not look like the next one's time jump
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  double next() { return now_ += 0.1; }
  /// Sends pairs of one cluster and its detection until one comes out matched: all that is needed is there.
  bool matches() {
    const int before = out_.count;
    const auto matched = [&] {
      return out_.count > before && out_.last->obstacles.size() == 1 &&
             out_.last->obstacles[0].reason == Obstacle::MATCHED;
    };
    return spinUntil(matched, [this] {
      detections_.send(detectionsAt(next(), {4.f}));
      clusters_.send(clustersAt(now_, {{5.0, 0.5}}));
    });
  }
  /// Waits for the last word on the clusters of now_.
  bool answered() {
    return spinUntil([this] {
      return out_.last && out_.last->header.stamp == ros::Time(now_) && !out_.last->provisional;
    });
  }
  bool reports(const std::string& input, const std::string& kind) {
    return spinUntil([&] { return !diagnostics_.value("match", input + ": dropped, " + kind).empty(); });
  }

  double now_ = 0.0;
  Received<ObstacleArray> out_{"obstacles"};
  Sender<ClusterArray> clusters_{"clusters"};
  Sender<ImageDetectionArray> detections_{"detections"};
  Diagnostics diagnostics_;
};

TEST_F(MatchStage, PairAgreesAcrossTheDistanceOfTheSensors) {
  ASSERT_TRUE(matches());
  const auto& o = out_.last->obstacles[0];
  EXPECT_EQ(out_.last->header.frame_id, "lidar");
  EXPECT_EQ(out_.last->revision, 1);
  EXPECT_EQ(o.source, Obstacle::SOURCE_BOTH);
  EXPECT_EQ(o.cluster_id, 0);
  EXPECT_EQ(o.detection_id, 0);
  EXPECT_EQ(o.label, "boat");
  EXPECT_NEAR(o.range_difference, 0.0, 1e-5);
  EXPECT_NEAR(o.azimuth_difference, 0.0, 1e-5);
}

TEST_F(MatchStage, UnmatchedOfBothSidesStay) {
  ASSERT_TRUE(matches());
  detections_.send(detectionsAt(next(), {4.f, 40.f}));
  clusters_.send(clustersAt(now_, {{5.0, 0.5}, {9.0, -9.0}}));
  ASSERT_TRUE(answered());
  ASSERT_EQ(out_.last->obstacles.size(), 3u);
  EXPECT_EQ(out_.last->obstacles[0].source, Obstacle::SOURCE_BOTH);
  EXPECT_EQ(out_.last->obstacles[1].source, Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(out_.last->obstacles[1].cluster_id, 1);
  EXPECT_EQ(out_.last->obstacles[2].source, Obstacle::SOURCE_CAMERA);
  EXPECT_EQ(out_.last->obstacles[2].detection_id, 1);
  EXPECT_EQ(out_.last->obstacles[2].reason, Obstacle::RANGE_DIFFERS);
}

TEST_F(MatchStage, EmptyOnBothSidesGivesAnEmptyArray) {
  ASSERT_TRUE(matches());
  detections_.send(detectionsAt(next(), {}));
  clusters_.send(clustersAt(now_, {}));
  ASSERT_TRUE(answered());
  EXPECT_EQ(out_.last->revision, 1);
  EXPECT_TRUE(out_.last->obstacles.empty());
}

TEST_F(MatchStage, SilentCameraLeavesTheLidarAlone) {
  ASSERT_TRUE(matches());
  clusters_.send(clustersAt(next(), {{5.0, 0.5}}));
  ASSERT_TRUE(answered());
  EXPECT_EQ(out_.last->revision, 1);
  ASSERT_EQ(out_.last->obstacles.size(), 1u);
  EXPECT_EQ(out_.last->obstacles[0].source, Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(out_.last->obstacles[0].reason, Obstacle::NO_PARTNER_MESSAGE);
  clusters_.send(clustersAt(next(), {{5.0, 0.5}}));
  ASSERT_TRUE(answered());
  EXPECT_EQ(out_.last->revision, 0) << "nobody waits any more";
  EXPECT_TRUE(matches());
}

TEST_F(MatchStage, LidarGoesOutAtOnceAndAgainWithTheCamera) {
  ASSERT_TRUE(matches());
  clusters_.send(clustersAt(next(), {{5.0, 0.5}}));
  ASSERT_TRUE(spinUntil([this] { return out_.last->header.stamp == ros::Time(now_); }));
  EXPECT_EQ(out_.last->revision, 0);
  EXPECT_TRUE(out_.last->provisional);
  ASSERT_EQ(out_.last->obstacles.size(), 1u);
  EXPECT_EQ(out_.last->obstacles[0].source, Obstacle::SOURCE_LIDAR);
  detections_.send(detectionsAt(now_, {4.f}));
  ASSERT_TRUE(answered());
  EXPECT_EQ(out_.last->revision, 1);
  EXPECT_EQ(out_.last->obstacles[0].reason, Obstacle::MATCHED);
}

TEST_F(MatchStage, SilentLidarLeavesTheCameraAlone) {
  ASSERT_TRUE(matches());
  const auto alone = [this] {
    return out_.last->obstacles.size() == 1 && out_.last->obstacles[0].source == Obstacle::SOURCE_CAMERA;
  };
  ASSERT_TRUE(spinUntil(alone, [this] { detections_.send(detectionsAt(next(), {4.f})); }));
  EXPECT_EQ(out_.last->header.frame_id, "lidar");
  EXPECT_EQ(out_.last->revision, 1);
  EXPECT_NEAR(out_.last->obstacles[0].position.x, 5.0, 1e-5);
  EXPECT_EQ(out_.last->obstacles[0].cluster_id, -1);
  EXPECT_TRUE(matches());
}

TEST_F(MatchStage, MissingTransformIsNamedAndTheLidarGoesOn) {
  ASSERT_TRUE(matches());
  detections_.send(detectionsAt(next(), {4.f}, "adrift"));
  clusters_.send(clustersAt(now_, {{5.0, 0.5}}));
  ASSERT_TRUE(answered());
  ASSERT_EQ(out_.last->obstacles.size(), 2u);
  EXPECT_EQ(out_.last->obstacles[0].source, Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(out_.last->obstacles[1].reason, Obstacle::NO_BEARING);
  EXPECT_TRUE(std::isnan(out_.last->obstacles[1].position.x));
  EXPECT_TRUE(reports("detections", "no transform"));
  EXPECT_TRUE(matches());
}

TEST_F(MatchStage, DamagedMessagesAreDroppedAndNamed) {
  ASSERT_TRUE(matches());
  auto clusters = clustersAt(next(), {{5.0, 0.5}});
  clusters.clusters[0].centre.x = NAN;
  clusters_.send(clusters);
  EXPECT_TRUE(reports("clusters", "clusters damaged"));
  for (const auto& [score, x_max] : {std::pair<float, float>{NAN, 5.f}, {0.5f, -1.f}}) {
    const int before =
        std::atoi(diagnostics_.value("match", "detections: dropped, detections damaged").c_str());
    auto detections = detectionsAt(next(), {4.f});
    detections.width = detections.height = 100;
    detections.detections[0].score = score;
    detections.detections[0].x_min = -2.f;  // the second box lies outside the image
    detections.detections[0].x_max = x_max;
    detections_.send(detections);
    EXPECT_TRUE(spinUntil([&] {
      return std::atoi(diagnostics_.value("match", "detections: dropped, detections damaged").c_str()) >
             before;
    }));
  }
  EXPECT_TRUE(matches());
}

TEST_F(MatchStage, OutOfOrderIsDroppedAndStampsRise) {
  ASSERT_TRUE(matches());
  const auto newest = out_.last->header.stamp;
  clusters_.send(clustersAt(newest.toSec() - 0.5, {{5.0, 0.5}}));
  EXPECT_TRUE(reports("clusters", "stamp out of order"));
  EXPECT_EQ(out_.last->header.stamp, newest);
  EXPECT_TRUE(matches());
}

TEST_F(MatchStage, LoopingBagIsATimeJumpAndGoesOn) {
  ASSERT_TRUE(matches());
  now_ -= 60.0;
  ASSERT_TRUE(matches());
  EXPECT_LT(out_.last->header.stamp.toSec(), now_ + 1.0);
}

TEST_F(MatchStage, PairsAndOffsetsAreInDiagnostics) {
  ASSERT_TRUE(matches());
  EXPECT_TRUE(spinUntil([&] { return std::atoi(diagnostics_.value("match", "pairs").c_str()) > 0; }));
  EXPECT_NE(diagnostics_.value("match", "camera: offset to clusters [ms]").find("0..5: "), std::string::npos);
}

TEST_F(MatchStage, OffsetBeyondHalfOfTheIntervalIsAWarning) {
  ASSERT_TRUE(matches());
  const auto warned = [this] { return diagnostics_.says("match: stage", "time_offset"); };
  EXPECT_TRUE(spinUntil(warned, [this] {
    detections_.send(detectionsAt(next() + 0.04, {4.f}));
    clusters_.send(clustersAt(now_, {{5.0, 0.5}}));
  }));
}

TEST_F(MatchStage, WithoutAnyFrameCamerasAloneAreDroppedAndNamed) {
  Received<ObstacleArray> out("none/obstacles");
  Sender<ImageDetectionArray> detections("none/detections");
  const std::string key = "detections: dropped, no frame for what cameras see";
  EXPECT_TRUE(spinUntil([&] { return !diagnostics_.value("match_none", key).empty(); },
                        [&] { detections.send(detectionsAt(next(), {4.f})); }));
  EXPECT_EQ(out.count, 0);
}

TEST_F(MatchStage, TwoCamerasEachWithItsClockAnswerForOneLidar) {
  Received<ObstacleArray> out("two/obstacles");
  Sender<ClusterArray> clusters("two/clusters");
  Sender<ImageDetectionArray> left("two/left/detections"), right("two/right/detections");
  ASSERT_TRUE(spinUntil([&] { return clusters.connected() && left.connected() && right.connected(); }));
  right.send(detectionsAt(0.05, {4.f}));  // its offset takes the stamp below zero: that ends no stage
  EXPECT_TRUE(spinUntil([&] { return std::atoi(diagnostics_.value("match_two", "right/detections: received").c_str()) > 0; }));
  const auto alone = [&] { return out.last && out.last->obstacles.size() == 1; };
  ASSERT_TRUE(spinUntil(alone, [&] { left.send(detectionsAt(next(), {4.f})); })) << "no clusters yet";
  EXPECT_EQ(out.last->header.frame_id, "lidar") << "by the parameter frame";

  const auto both = [&] {
    return out.last && out.last->revision == 1 && out.last->obstacles.size() == 3 &&
           out.last->obstacles[0].reason == Obstacle::MATCHED;
  };
  const auto send = [&] {
    left.send(detectionsAt(next(), {4.f, 20.f}));
    auto seen = detectionsAt(now_ + 0.08, {4.f, 20.05f, 60.f});
    right.send(seen);
    clusters.send(clustersAt(now_, {{5.0, 0.5}}));
  };
  ASSERT_TRUE(spinUntil(both, send));
  EXPECT_EQ(out.last->obstacles[1].source, Obstacle::SOURCE_CAMERA);
  EXPECT_NEAR(out.last->obstacles[1].range, 21.0, 0.1) << "seen by both, one obstacle";
  EXPECT_EQ(out.last->obstacles[2].camera, 1);
  EXPECT_EQ(out.last->obstacles[2].detection_id, 2);
  EXPECT_TRUE(
      spinUntil([&] { return !diagnostics_.value("match_two", "right: offset to clusters [ms]").empty(); }));
}

TEST_F(MatchStage, AMovedSensorIsWarnedOf) {
  ASSERT_TRUE(matches());
  const auto pairsAt = [this](double aside, int seconds) {
    for (int i = 0; i < seconds; ++i) {
      now_ += 1.0;
      detections_.send(detectionsAt(now_, {4.f}));
      clusters_.send(clustersAt(now_, {{5.0, 0.5 + aside}}));
      if (!answered()) return false;
    }
    return true;
  };
  const auto warned = [this] { return diagnostics_.says("match", "boxes have shifted"); };
  ASSERT_TRUE(pairsAt(0.0, 95));
  const std::string mean = "camera: boxes off clusters, azimuth and elevation [deg]";
  ASSERT_TRUE(spinUntil([&] { return !diagnostics_.value("match", mean).empty(); }));
  EXPECT_FALSE(warned());
  ASSERT_TRUE(pairsAt(0.08, 32));  // nearly 1 deg
  EXPECT_TRUE(spinUntil(warned));
}

}  // namespace
}  // namespace field_fusion::test
