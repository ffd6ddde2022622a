#include "field_fusion/core/map/scan_matcher.h"

#include <gtest/gtest.h>

#include "field_fusion/core/map/scan_insertion.h"
#include "room.h"

namespace field_fusion::core {
namespace {

MatchSettings settings() {
  MatchSettings out;
  out.sigma = 0.03;
  return out;
}

TileMap roomMap() {
  TileMap map;
  ScanInsertion insertion;
  for (const Pose2& pose : {Pose2{0, 0, 0}, Pose2{1, -1, 0.3}, Pose2{-2, 0.5, 2}, Pose2{3.5, -1.5, -1}})
    insertion.insert(test::roomScan(pose), pose, 0.05, 1, map);
  return map;
}

PosePrior loose(const Pose2& mean) {
  PosePrior prior;
  prior.mean = mean;
  prior.covariance = Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal();
  return prior;
}

TEST(ScanMatcher, FindsTheWayBackInAnAnalyticRoom) {
  TileMap map = roomMap();
  ScanMatcher matcher(settings());
  for (const Pose2& truth : {Pose2{0.4, -0.3, 0.7}, Pose2{-1.5, -1.0, -2.0}, Pose2{3.0, 1.5, 3.1}})
    for (const Pose2& off : {Pose2{0, 0, 0}, Pose2{0.3, -0.2, 0.1}, Pose2{-0.25, 0.3, -0.2}}) {
      const Pose2 start{truth.x + off.x, truth.y + off.y, truth.yaw + off.yaw};
      const Match match = matcher.match(test::roomScan(truth), map, loose(start));
      EXPECT_NEAR(match.peak.x, truth.x, 0.01);
      EXPECT_NEAR(match.peak.y, truth.y, 0.01);
      EXPECT_NEAR(angleDifference(match.peak.yaw, truth.yaw), 0.0, 0.005);
      EXPECT_GT(match.score, 300.0);
      EXPECT_LT((match.mean.position() - match.peak.position()).norm(), 0.01);
      EXPECT_LT(match.covariance(0, 0), 1e-3);
      EXPECT_GT(match.covariance(0, 0), 0.0);
    }
}

TEST(ScanMatcher, BelievesOdometryAlongACorridorWithoutFeatures) {
  TileMap map;
  SlamScan scan;
  for (double x = -8.0; x <= 8.0; x += 0.02)
    for (const double y : {-1.0, 1.0}) scan.hits.push_back({Eigen::Vector2f(x, y), Eigen::Vector2f(0, 1)});
  ScanInsertion().insert(scan, {}, 0.05, 1, map);
  scan.hits.erase(std::remove_if(scan.hits.begin(), scan.hits.end(),
                                 [](const ScanHit& hit) { return std::abs(hit.end.x()) > 5.f; }),
                  scan.hits.end());
  const Match match = ScanMatcher(settings()).match(scan, map, loose({0.7, 0.2, 0.05}));
  EXPECT_NEAR(match.peak.x, 0.7, 0.02);
  EXPECT_NEAR(match.peak.y, 0.0, 0.01);
  EXPECT_NEAR(match.peak.yaw, 0.0, 0.005);
  EXPECT_GT(match.covariance(0, 0), 0.3 * 0.04) << "the scan says nothing along the corridor";
}

TEST(ScanMatcher, MoreLikelyAtTheTruthThanBesideIt) {
  TileMap map = roomMap();
  ScanMatcher matcher(settings());
  const Pose2 truth{0.4, -0.3, 0.7};
  const SlamScan scan = test::roomScan(truth);
  const double best = matcher.logLikelihood(scan, map, truth);
  EXPECT_LE(best, 0.0);
  for (const Pose2& beside : {Pose2{0.5, -0.3, 0.7}, Pose2{0.4, -0.2, 0.7}, Pose2{0.4, -0.3, 0.75}, Pose2{90, 90, 0}})
    EXPECT_LT(matcher.logLikelihood(scan, map, beside), best - 1.0);
}

}  // namespace
}  // namespace field_fusion::core
