#include "field_fusion/core/match/match.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

Cluster clusterAt(double range, double azimuth_degrees) {
  Cluster out;
  out.polar = {range, radians(azimuth_degrees), 0.0};
  out.centre = cartesian(out.polar).cast<float>();
  out.box = {out.centre, out.centre};
  return out;
}

CameraTarget targetAt(int id, double range, double azimuth_degrees) {
  CameraTarget out;
  out.id = id;
  out.polar = {range, radians(azimuth_degrees), 0.0};
  return out;
}

TEST(Matcher, NothingGivesNothing) {
  EXPECT_TRUE(Matcher().run({}, {}).empty());
  EXPECT_TRUE(Matcher().runAlone({}).empty());
}

TEST(Matcher, KeepsWhatOneSensorAloneSaw) {
  Matcher matcher;
  const auto& obstacles =
      matcher.run({clusterAt(5, 0), clusterAt(9, 40)}, {targetAt(0, 30, -30), targetAt(1, 5.2, 1)});
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_EQ(obstacles[0].source, ObstacleSource::kBoth);
  EXPECT_EQ(obstacles[0].cluster, 0);
  EXPECT_EQ(obstacles[0].detection, 1);
  EXPECT_EQ(obstacles[1].source, ObstacleSource::kLidar);
  EXPECT_EQ(obstacles[1].cluster, 1);
  EXPECT_EQ(obstacles[2].source, ObstacleSource::kCamera);
  EXPECT_EQ(obstacles[2].detection, 0);
}

TEST(Matcher, NothingStaysFromTheCallBefore) {
  Matcher matcher;
  matcher.run({clusterAt(5, 0)}, {targetAt(0, 5, 0), targetAt(1, 20, 0)});
  EXPECT_TRUE(matcher.run({}, {}).empty());
}

TEST(Matcher, AloneSaysThatNoMessageCame) {
  Matcher matcher;
  const auto& obstacles = matcher.runAlone({clusterAt(5, 0), clusterAt(9, 40)});
  ASSERT_EQ(obstacles.size(), 2u);
  for (const Obstacle& o : obstacles) {
    EXPECT_EQ(o.source, ObstacleSource::kLidar);
    EXPECT_EQ(o.verdict.reason, MatchReason::kNoPartnerMessage);
  }
}

TEST(Matcher, NewParametersHoldFromTheNextCall) {
  Matcher matcher;
  MatchParams params;
  params.tolerance.dist_tolerance = 0.1;
  EXPECT_EQ(matcher.run({clusterAt(5, 0)}, {targetAt(0, 5.2, 0)}).size(), 1u);
  matcher.setParams(params);
  EXPECT_EQ(matcher.run({clusterAt(5, 0)}, {targetAt(0, 5.2, 0)}).size(), 2u);
}

TEST(MatchParams, DefaultsAreValid) {
  MatchParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
}

}  // namespace
}  // namespace field_fusion::core
