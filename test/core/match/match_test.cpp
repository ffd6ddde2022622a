#include "field_fusion/core/match/match.h"

#include <gtest/gtest.h>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::personAt;
using test::seenBy;
using test::Solid;

const Transform kLeft = test::lookingAhead({0, 0.4, 0}), kRight = test::lookingAhead({0, -0.4, 0});

using Views = std::vector<std::optional<CameraView>>;

CameraView viewOf(const Transform& camera, const std::vector<Solid>& seen, double range_sigma = 0.5) {
  CameraView out = test::viewFrom(camera);
  for (const Solid& solid : seen)
    out.targets.push_back(seenBy(camera, solid, static_cast<int>(out.targets.size()), range_sigma));
  return out;
}

class MatcherTest : public testing::TestWithParam<MatchMethod> {
 protected:
  void addCluster(const std::vector<Solid>& solids) { clusters_.push_back(test::scan(solids, points_)); }
  const std::vector<Obstacle>& run(const Views& views) {
    MatchParams params;
    params.method = GetParam();
    matcher_.setParams(params);
    return matcher_.run(clusters_, points_, views);
  }

  std::vector<Point> points_;
  std::vector<Cluster> clusters_;
  Matcher matcher_;
};
INSTANTIATE_TEST_SUITE_P(Methods, MatcherTest, testing::Values(MatchMethod::kOptimal, MatchMethod::kPaper));

TEST_P(MatcherTest, NothingGivesNothing) {
  EXPECT_TRUE(run({}).empty());
  EXPECT_TRUE(run({CameraView{}}).empty());
}

// the foot and the topmark of a buoy, whose nominal diameter is 0.8 m
TEST_P(MatcherTest, PiecesOfABodyOfKnownSizeBecomeTheWholeByTheOptimalMethodAlone) {
  const Solid foot{{8, -0.1, -1.2}, {8, 0.1, -0.9}}, top{{8, -0.1, -0.4}, {8, 0.1, -0.2}};
  addCluster({foot}), addCluster({top});
  CameraView view = viewOf(kLeft, {{{8, -0.4, -1.2}, {8.8, 0.4, -0.2}}});
  view.targets[0].label = "buoy";
  const auto& obstacles = run({view});
  if (GetParam() == MatchMethod::kPaper) {
    ASSERT_EQ(obstacles.size(), 2u);
    EXPECT_TRUE(obstacles[0].joined.empty() && obstacles[1].joined.empty());
    EXPECT_NEAR(obstacles[0].position.x(), 8.0, 1e-5);
    EXPECT_NEAR(obstacles[0].face.norm(), std::hypot(8.0, 0.9), 0.02);
    return;
  }
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].joined.size(), 1u);
  EXPECT_EQ(obstacles[0].cluster + obstacles[0].joined[0], 1);
  EXPECT_NEAR(obstacles[0].position.x(), 8.4, 0.05);
  EXPECT_NEAR(obstacles[0].position.y(), 0.0, 0.02);
  EXPECT_NEAR(obstacles[0].size.y(), 0.8, 0.09);
  EXPECT_NEAR(obstacles[0].polar.range, obstacles[0].position.norm(), 1e-9);
  EXPECT_NEAR(obstacles[0].face.head<2>().norm(), 8.0, 0.03);
}

TEST_P(MatcherTest, TheFaceIsTheNearestOfWhatTheLidarSaw) {
  addCluster({{{6, 1, -0.5}, {6, 3, 0.5}}});
  const auto& obstacles = run({viewOf(kLeft, {personAt(30, -15)})});
  ASSERT_EQ(obstacles.size(), 2u);
  EXPECT_NEAR(obstacles[0].face.norm(), std::hypot(6.0, 1.0), 0.02);
  EXPECT_TRUE(obstacles[1].face.array().isNaN().all());
}

TEST_P(MatcherTest, KeepsWhatOneSensorAloneSaw) {
  addCluster({personAt(5, 0)}), addCluster({personAt(9, 7)});
  const auto& obstacles = run({viewOf(kLeft, {personAt(30, -15), personAt(5, 0)})});
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_EQ(obstacles[0].source, ObstacleSource::kBoth);
  EXPECT_EQ(obstacles[0].cluster, 0);
  EXPECT_EQ(obstacles[0].camera, 0);
  EXPECT_EQ(obstacles[0].detection, 1);
  EXPECT_EQ(obstacles[1].source, ObstacleSource::kLidar);
  EXPECT_EQ(obstacles[1].cluster, 1);
  EXPECT_EQ(obstacles[1].camera, -1);
  EXPECT_EQ(obstacles[2].source, ObstacleSource::kCamera);
  EXPECT_EQ(obstacles[2].detection, 0);
}

TEST_P(MatcherTest, NothingStaysFromTheCallBefore) {
  addCluster({personAt(5, 0)});
  run({viewOf(kLeft, {personAt(5, 0), personAt(20, 0)})});
  clusters_.clear();
  EXPECT_TRUE(run({CameraView{}}).empty());
}

TEST_P(MatcherTest, WithoutAnyAnswerEachClusterSaysSo) {
  addCluster({personAt(5, 0)}), addCluster({personAt(9, 7)});
  for (const Views& views : {Views{}, Views{std::nullopt, std::nullopt}}) {
    const auto& obstacles = run(views);
    ASSERT_EQ(obstacles.size(), 2u);
    for (const Obstacle& o : obstacles) EXPECT_EQ(o.verdict.reason, MatchReason::kNoPartnerMessage);
  }
}

TEST_P(MatcherTest, BodyThatTwoCamerasSeeGoesToTheBetterOne) {
  addCluster({personAt(6, 0)});
  const auto& obstacles = run({viewOf(kLeft, {personAt(6.6, 0.1)}), viewOf(kRight, {personAt(6, 0)})});
  ASSERT_EQ(obstacles.size(), 1u) << "the other camera's box is this body too";
  EXPECT_EQ(obstacles[0].camera, 1);
  EXPECT_EQ(obstacles[0].source, ObstacleSource::kBoth);
}

TEST_P(MatcherTest, CameraThatHasNotAnsweredHasNoSay) {
  addCluster({personAt(6, 0)});
  const auto& obstacles = run({std::nullopt, viewOf(kRight, {personAt(6, 0)})});
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_EQ(obstacles[0].camera, 1);
}

TEST_P(MatcherTest, CamerasAloneAgreeOnOneBody) {
  const auto& obstacles = run({viewOf(kLeft, {personAt(20, 3), personAt(12, -4)}, 2.0),
                               viewOf(kRight, {personAt(12.5, -4), personAt(20, -6)}, 1.0)});
  ASSERT_EQ(obstacles.size(), 3u);
  EXPECT_EQ(obstacles[0].camera, 0);
  EXPECT_EQ(obstacles[1].camera, 1) << "it knows the place better";
  EXPECT_EQ(obstacles[1].detection, 0);
  EXPECT_EQ(obstacles[2].detection, 1);
}

TEST_P(MatcherTest, BodiesOfOneCameraAreNeverMerged) {
  EXPECT_EQ(run({viewOf(kLeft, {personAt(20, 3), personAt(20.1, 3)}, 2.0)}).size(), 2u);
}

TEST(Matcher, PeopleInOneClusterAreTwoObstaclesByOptimalAndOneByPaper) {
  std::vector<Point> points;
  const Solid left = personAt(6, 0.45), right = personAt(6, -0.45);
  const std::vector<Cluster> clusters{test::scan({left, right}, points)};
  MatchParams params;
  Matcher matcher(params);
  const auto& two = matcher.run(clusters, points, {viewOf(kLeft, {left, right})});
  ASSERT_EQ(two.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(two[i].source, ObstacleSource::kBoth);
    EXPECT_EQ(two[i].cluster, 0);
    EXPECT_EQ(two[i].part, i + 1);
    EXPECT_EQ(two[i].detection, i);
    EXPECT_NEAR(two[i].size.y(), 0.5, 1e-5);
  }
  params.method = MatchMethod::kPaper;
  matcher.setParams(params);
  const auto& paper = matcher.run(clusters, points, {viewOf(kLeft, {left, right})});
  EXPECT_EQ(paper[0].part, 0);
  EXPECT_EQ(std::count_if(paper.begin(), paper.end(), [](auto& o) { return o.cluster == 0; }), 1);
}

TEST(Matcher, NewParametersHoldFromTheNextCall) {
  std::vector<Point> points;
  const std::vector<Cluster> clusters{test::scan({personAt(5, 0)}, points)};
  const Views views{viewOf(kLeft, {personAt(5.5, 0)}, 0.3)};
  Matcher matcher;
  EXPECT_EQ(matcher.run(clusters, points, views).size(), 1u);
  MatchParams params;
  params.gate.gate_probability = 0.5;
  matcher.setParams(params);
  EXPECT_EQ(matcher.run(clusters, points, views).size(), 2u);
}

TEST(MatchParams, DefaultsAreValid) {
  MatchParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
}

}  // namespace
}  // namespace field_fusion::core
