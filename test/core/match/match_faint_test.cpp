// A black buoy returns one or two points: too few for a cluster, enough beside a box of the camera.
#include <gtest/gtest.h>

#include "field_fusion/core/match/match.h"
#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::seenBy;
using test::Solid;

const Transform kCamera = test::lookingAhead({0, 0, 0.2});

Solid buoyAt(double x, double y) { return {{x, y - 0.2, -0.5}, {x + 0.4, y + 0.2, 0.3}}; }

class FaintMatch : public testing::Test {
 protected:
  void addPoint(double x, double y, double z, bool faint = true) {
    Point point;
    point.x = static_cast<float>(x), point.y = static_cast<float>(y), point.z = static_cast<float>(z);
    Cluster cluster;
    cluster.points = {static_cast<std::uint32_t>(points_.size()), 1};
    cluster.faint = faint;
    cluster.nearest_range = point.position().norm();
    points_.push_back(point);
    describe(cluster, &points_.back(), 1, nullptr);
    clusters_.push_back(cluster);
  }
  void see(const Solid& solid, double sigma = 1.0) {
    view_.targets.push_back(seenBy(kCamera, solid, static_cast<int>(view_.targets.size()), sigma));
  }
  const std::vector<Obstacle>& run(MatchMethod method = MatchMethod::kOptimal) {
    MatchParams params;
    params.method = method;
    matcher_.setParams(params);
    return matcher_.run(clusters_, points_, {view_});
  }

  std::vector<Point> points_;
  std::vector<Cluster> clusters_;
  CameraView view_ = test::viewFrom(kCamera);
  Matcher matcher_;
};

TEST_F(FaintMatch, PointInABoxAtItsRangeIsKept) {
  addPoint(20.1, 3.0, -0.1);
  see(buoyAt(20, 3));
  const auto& obstacles = run();
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].source, ObstacleSource::kBoth);
  EXPECT_EQ(obstacles[0].cluster, 0);
  EXPECT_EQ(obstacles[0].detection, 0);
  EXPECT_NEAR(obstacles[0].position.x(), 20.1, 1e-5) << "the LiDAR's range, not the camera's";
  EXPECT_DOUBLE_EQ(obstacles[0].existence, 1.0 - (1.0 - 0.2) * (1.0 - 0.9 * 0.9));
}

TEST_F(FaintMatch, NobodySpeaksForItAlone) {
  addPoint(20.1, 3.0, -0.1);
  EXPECT_TRUE(run().empty());
  EXPECT_TRUE(matcher_.run(clusters_, points_, {}).empty()) << "no camera has answered";
}

TEST_F(FaintMatch, PointFarBehindOrBesideTheBoxIsNotTaken) {
  addPoint(40.0, 6.0, -0.1), addPoint(20.1, 4.0, -0.1);
  see(buoyAt(20, 3));
  const auto& obstacles = run();
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].source, ObstacleSource::kCamera);
  EXPECT_EQ(obstacles[0].cluster, -1);
}

TEST_F(FaintMatch, DirectionAloneIsNotEnough) {
  addPoint(20.1, 3.0, -0.1);
  see(buoyAt(20, 3));
  view_.targets[0].ray_range = view_.targets[0].range_sigma = view_.targets[0].seen.range = kNaN;
  ASSERT_EQ(run().size(), 1u);
  EXPECT_EQ(run()[0].source, ObstacleSource::kCamera);
}

TEST_F(FaintMatch, WholeClusterComesFirst) {
  addPoint(20.2, 3.0, -0.1, false), addPoint(20.1, 3.0, -0.1);
  see(buoyAt(20, 3));
  const auto& obstacles = run();
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].cluster, 0);
}

TEST_F(FaintMatch, EachOfTwoBoxesTakesItsOwn) {
  addPoint(20.1, 3.0, -0.1), addPoint(20.1, -3.0, -0.1);
  see(buoyAt(20, -3)), see(buoyAt(20, 3));
  const auto& obstacles = run();
  ASSERT_EQ(obstacles.size(), 2u);
  for (const Obstacle& o : obstacles) EXPECT_EQ(o.detection, o.cluster == 0 ? 1 : 0);
}

TEST_F(FaintMatch, TwoCamerasThatSeeItGiveOneObstacle) {
  addPoint(20.1, 3.0, -0.1);
  see(buoyAt(20, 3));
  MatchParams params;
  params.sync.cameras = {"left", "right"};
  Matcher matcher(params);
  const auto& obstacles = matcher.run(clusters_, points_, {view_, view_});
  const auto fused = std::count_if(obstacles.begin(), obstacles.end(),
                                   [](const Obstacle& o) { return o.source == ObstacleSource::kBoth; });
  EXPECT_EQ(fused, 1);
}

TEST_F(FaintMatch, ThePapersMethodKnowsNone) {
  addPoint(20.1, 3.0, -0.1);
  see(buoyAt(20, 3));
  ASSERT_EQ(run(MatchMethod::kPaper).size(), 1u);
  EXPECT_EQ(run(MatchMethod::kPaper)[0].source, ObstacleSource::kCamera);
}

}  // namespace
}  // namespace field_fusion::core
