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
    d.ray.z = 1.0;
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
  /// Waits for the answer to the clusters of now_.
  bool answered() {
    return spinUntil([this] { return out_.last && out_.last->header.stamp == ros::Time(now_); });
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
  EXPECT_EQ(out_.last->revision, 0);
  ASSERT_EQ(out_.last->obstacles.size(), 1u);
  EXPECT_EQ(out_.last->obstacles[0].source, Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(out_.last->obstacles[0].reason, Obstacle::NO_PARTNER_MESSAGE);
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
  detections_.send(detectionsAt(next(), {-1.f}));
  EXPECT_TRUE(reports("detections", "detections damaged"));
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

TEST_F(MatchStage, PairsAreCountedInDiagnostics) {
  ASSERT_TRUE(matches());
  const std::string key = "pairs, clusters alone, detections too late";
  EXPECT_TRUE(spinUntil([&] { return std::atoi(diagnostics_.value("match", key).c_str()) > 0; }));
}

}  // namespace
}  // namespace field_fusion::test
