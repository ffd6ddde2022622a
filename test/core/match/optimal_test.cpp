#include "field_fusion/core/match/optimal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::personAt;
using test::seenBy;
using test::Solid;

const Transform kCamera = test::lookingAhead({0.3, -0.2, 0.1});

OptimalMatcher matcher() {
  Gate gate;
  gate.setParams({}, 0.03, radians(0.5));
  OptimalMatcher out;
  out.setGate(gate);
  return out;
}

struct Scene {
  std::vector<Point> points;
  std::vector<LidarTarget> bodies;
  CameraView view = test::viewFrom(kCamera);

  void addCluster(const Solid& solid) {
    bodies.push_back({test::scan({solid}, points), static_cast<int>(bodies.size()), 0, {}});
  }
  CameraTarget& addTarget(const Solid& solid, double range_sigma = 0.5) {
    view.targets.push_back(seenBy(kCamera, solid, static_cast<int>(view.targets.size()), range_sigma));
    return view.targets.back();
  }
  Verdicts run() const { return matcher().run(bodies, view); }
};

TEST(OptimalMatcher, EmptySidesGiveEmptyVerdicts) {
  Scene scene;
  EXPECT_TRUE(scene.run().lidar.empty());
  scene.addCluster(personAt(5, 0));
  EXPECT_EQ(scene.run().lidar[0].reason, MatchReason::kNoCandidate);
  scene.bodies.clear();
  scene.addTarget(personAt(5, 0));
  EXPECT_EQ(scene.run().camera[0].reason, MatchReason::kNoCandidate);
}

TEST(OptimalMatcher, PairTellsBothDifferencesAndItsDistance) {
  Scene scene;
  scene.addCluster(personAt(6, 1));
  scene.addTarget(personAt(6.2, 1));
  const Verdicts v = scene.run();
  for (const Verdict& side : {v.lidar[0], v.camera[0]}) {
    EXPECT_EQ(side.reason, MatchReason::kMatched);
    EXPECT_EQ(side.partner, 0);
    EXPECT_NEAR(side.range_difference, -0.2, 0.02);
    EXPECT_NEAR(side.azimuth_difference,
                scene.bodies[0].cluster.polar.azimuth - scene.view.targets[0].polar.azimuth, 1e-12);
    EXPECT_LT(std::abs(side.azimuth_difference), radians(1));
    EXPECT_GT(side.distance, 0.0);
    EXPECT_LT(side.distance, 2.0);
  }
}

TEST(OptimalMatcher, ReasonIsTheLargestOfTheThreeDifferences) {
  const auto reason = [](const Solid& seen) {
    Scene scene;
    scene.addCluster(personAt(6, 0));
    scene.addTarget(seen);
    const Verdicts v = scene.run();
    EXPECT_EQ(v.lidar[0].reason, v.camera[0].reason);
    return v.lidar[0].reason;
  };
  Solid raised = personAt(6, 0);
  raised.low.z() += 1.0, raised.high.z() += 1.0;
  EXPECT_EQ(reason(personAt(12, 0)), MatchReason::kRangeDiffers);
  EXPECT_EQ(reason(personAt(6, 1)), MatchReason::kAzimuthDiffers);
  EXPECT_EQ(reason(raised), MatchReason::kElevationDiffers);
}

TEST(OptimalMatcher, TwoBoxesOnOneBodyLeaveTheWorseTaken) {
  Scene scene;
  scene.addCluster(personAt(6, 0));
  scene.addTarget(personAt(6, 0.05));
  scene.addTarget(personAt(6, 0));
  const Verdicts v = scene.run();
  EXPECT_EQ(v.lidar[0].partner, 1);
  EXPECT_EQ(v.camera[0].reason, MatchReason::kTaken);
}

TEST(OptimalMatcher, SumCountsNotTheSinglePair) {
  Scene scene;  // the middle box is nearest to the first body, and the only one for the second
  scene.addCluster(personAt(8, 0.0));
  scene.addCluster(personAt(8, 0.30));
  scene.addTarget(personAt(8, 0.10));
  scene.addTarget(personAt(8, -0.15));
  const Verdicts v = scene.run();
  EXPECT_EQ(v.lidar[0].partner, 1);
  EXPECT_EQ(v.lidar[1].partner, 0);
}

TEST(OptimalMatcher, WithoutRangeTheDirectionDecidesWithoutParallax) {
  Scene scene;  // near the sensors, where direction from the LiDAR and from the camera differ by 3 deg
  scene.addCluster(personAt(4, 0));
  scene.addCluster(personAt(9, 3));
  CameraTarget& seen = scene.addTarget(personAt(4, 0));
  seen.ray_range = seen.seen.range = seen.range_sigma = kNaN;
  carryToLidar(seen, kCamera.linear().transpose() * seen.direction, kCamera);
  const Verdicts v = scene.run();
  EXPECT_EQ(v.camera[0].partner, 0);
  EXPECT_TRUE(std::isnan(v.camera[0].range_difference));
  EXPECT_LT(v.camera[0].distance, 1.0);
}

TEST(OptimalMatcher, BoxThatTheBorderCutsMatchesTheWholeBody) {
  Scene scene;
  const Solid car{{6, -1, -1}, {10, 1, 0.5}};
  scene.addCluster(car);
  Solid visible = car;
  visible.high.y() = -0.4;  // the rest lies beyond the border
  CameraTarget& seen = scene.addTarget(visible);
  seen.ray_range = seen.seen.range = seen.range_sigma = kNaN;
  EXPECT_EQ(scene.run().camera[0].reason, MatchReason::kMatched);
}

TEST(OptimalMatcher, DetectionWithoutBearingStaysAlone) {
  Scene scene;
  scene.addCluster(personAt(5, 0));
  scene.view.targets.push_back({});
  const Verdicts v = scene.run();
  EXPECT_EQ(v.camera[0].reason, MatchReason::kNoBearing);
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kNoBearing);
}

/// 500 people in the sector, seen with noise. Their own boxes, by place.
Scene crowd(int n, std::mt19937& random) {
  Scene scene;
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> range(4, 60), azimuth(-0.7, 0.7);
  for (int i = 0; i < n; ++i) {
    const double r = range(random), a = azimuth(random);
    const Solid person = personAt(r * std::cos(a), r * std::sin(a));
    scene.addCluster(person);
    CameraTarget& seen = scene.addTarget(person, 0.05 * r);
    seen.seen.range += 0.05 * r * noise(random);
    seen.seen.azimuth += radians(0.2) * noise(random);
  }
  return scene;
}

TEST(OptimalMatcher, SparseCrowdIsAllMatchedRight) {
  std::mt19937 random(4);
  int right = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Verdicts v = crowd(20, random).run();
    for (int i = 0; i < 20; ++i) right += v.lidar[i].partner == i;
  }
  EXPECT_GE(right, 390);
}

TEST(OptimalMatcher, OrderOfTargetsHasNoSayAmong500) {
  std::mt19937 random(9);
  Scene scene = crowd(500, random);
  const auto partners = [](const Scene& s) {
    const Verdicts v = s.run();
    std::vector<std::pair<int, int>> out;
    for (std::size_t i = 0; i < s.bodies.size(); ++i)
      out.emplace_back(s.bodies[i].place,
                       v.lidar[i].partner < 0 ? -1 : s.view.targets[v.lidar[i].partner].id);
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto expected = partners(scene);
  EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](auto& p) { return p.second >= 0; }), 450);
  std::shuffle(scene.bodies.begin(), scene.bodies.end(), random);
  std::shuffle(scene.view.targets.begin(), scene.view.targets.end(), random);
  EXPECT_EQ(partners(scene), expected);
}

TEST(OptimalMatcher, EqualTargetsPairByPlace) {
  Scene scene;
  for (int i = 0; i < 4; ++i) scene.addCluster(personAt(5, 0)), scene.addTarget(personAt(5, 0));
  const Verdicts v = scene.run();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(v.lidar[i].partner, i);
}

}  // namespace
}  // namespace field_fusion::core
