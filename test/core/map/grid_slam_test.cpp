#include "field_fusion/core/map/grid_slam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "room.h"

namespace field_fusion::core {
namespace {

GridSlamParams few(int threads = 1) {
  GridSlamParams params;
  params.particles = 8, params.linear_update = 0.0, params.angular_update = 0.0, params.threads = threads;
  return params;
}

/// Round the pillar; the odometry walks 4 % too far and turns 3 % too little.
struct Walk {
  Pose2 truth{0.0, -1.0, 0.0}, odometry{0.0, -1.0, 0.0};
  std::int64_t stamp_ns = 0;

  void step() {
    truth = truth * Pose2{0.1, 0.0, 0.08};
    odometry = odometry * Pose2{0.104, 0.0, 0.0776};
    stamp_ns += 100'000'000;
  }
};

TEST(GridSlam, CorrectsOdometryInARoom) {
  GridSlam slam(few());
  Walk walk;
  for (int i = 0; i < 60; ++i, walk.step()) {
    slam.process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns);
    EXPECT_LT((slam.pose().position() - walk.truth.position()).norm(), 0.03) << i;
    EXPECT_LT(std::abs(angleDifference(slam.pose().yaw, walk.truth.yaw)), 0.01) << i;
  }
  EXPECT_GT((walk.odometry.position() - walk.truth.position()).norm(), 0.05) << "or there was nothing to do";
  EXPECT_EQ(pathTo(slam.best().path.get()).size(), 60u);
}

TEST(GridSlam, IsTheSameWithAnyNumberOfThreads) {
  GridSlam one(few(1)), three(few(3));
  Walk walk;
  for (int i = 0; i < 25; ++i, walk.step())
    for (GridSlam* slam : {&one, &three}) slam->process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns);
  for (std::size_t i = 0; i < one.particles().size(); ++i) {
    const auto &a = one.particles()[i], &b = three.particles()[i];
    EXPECT_EQ(a.pose.x, b.pose.x);
    EXPECT_EQ(a.pose.y, b.pose.y);
    EXPECT_EQ(a.pose.yaw, b.pose.yaw);
    a.map.forEach([&b](TilePlace place, const Tile& tile, const NearestField*) {
      ASSERT_TRUE(b.map.tile(place));
      for (int k = 0; k < kTileCells; ++k) {
        const Cell x = tile.at(k % kTileSide, k / kTileSide), y = b.map.tile(place)->at(k % kTileSide, k / kTileSide);
        ASSERT_EQ(std::make_tuple(x.hits, x.visits, x.x, x.y), std::make_tuple(y.hits, y.visits, y.x, y.y));
      }
    });
  }
}

TEST(GridSlam, SkipsScansUntilItHasMoved) {
  GridSlamParams params = few();
  params.linear_update = 0.25, params.angular_update = 1000.0 / 3.0;
  GridSlam slam(params);
  Walk walk;
  int taken = 0;
  for (int i = 0; i < 31; ++i, walk.step()) {
    taken += slam.process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns) == GridSlam::Outcome::kProcessed;
    EXPECT_LT((slam.pose().position() - walk.truth.position()).norm(), 0.03) << "odometry goes on between";
  }
  EXPECT_EQ(taken, 11);  // the first, then every third step of 0.104 m
}

TEST(GridSlam, GoesOnByOdometryThroughBlindScansAndOtherSizes) {
  GridSlam slam(few());
  EXPECT_EQ(slam.process({}, {}, 1), GridSlam::Outcome::kBlind);
  Walk walk;
  for (int i = 0; i < 20; ++i, walk.step()) {
    SlamScan scan = test::roomScan(walk.truth, i % 3 == 1 ? 180 : 360);
    if (i % 5 == 4) scan.hits.clear();
    const auto outcome = slam.process(scan, walk.odometry, walk.stamp_ns);
    EXPECT_EQ(outcome, i % 5 == 4 ? GridSlam::Outcome::kBlind : GridSlam::Outcome::kProcessed);
    EXPECT_LT((slam.pose().position() - walk.truth.position()).norm(), 0.06) << i;
  }
}

TEST(GridSlam, TakesAJumpOfOdometryForAFault) {
  GridSlam slam(few());
  Walk walk;
  for (int i = 0; i < 20; ++i, walk.step()) {
    if (i == 10) walk.odometry.x += 10.0;
    slam.process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns);
    const double off = (slam.pose().position() - walk.truth.position()).norm();
    EXPECT_TRUE(off < 0.05 || i == 10) << i;
  }
  EXPECT_EQ(slam.odometryJumps(), 1u);
  EXPECT_THROW(slam.process(test::roomScan({}), {NAN, 0, 0}, 1), std::invalid_argument);
}

/// Its odometry begins at 0 again, 3 m and a right angle off, from one scan to the next.
TEST(GridSlam, ADriverThatStartsAnewIsNoMotion) {
  for (const Pose2& anew : {Pose2{-3, 0, 0}, Pose2{0, 0.1, radians(90)}}) {
    GridSlam slam(few());
    Walk walk;
    for (int i = 0; i < 20; ++i, walk.step()) {
      const Pose2 odometry = i < 10 ? walk.truth : anew * walk.truth;
      slam.process(test::roomScan(walk.truth), odometry, walk.stamp_ns);
      if (i > 11) EXPECT_LT((slam.pose().position() - walk.truth.position()).norm(), 0.05) << i;
    }
    EXPECT_EQ(slam.odometryJumps(), 1u);
  }
}

TEST(GridSlam, AfterAGapBetweenScansALongWayIsTrue) {
  GridSlam slam(few());
  slam.process(test::roomScan({}), {}, 1'000'000'000);
  const Pose2 on{2.0, 0.5, 0.3};
  slam.process(test::roomScan(on), {12.0, 0.5, 0.3}, 11'000'000'000);  // odometry ran for 10 s
  EXPECT_EQ(slam.odometryJumps(), 0u);
}

TEST(GridSlam, TellsWhetherAScanFits) {
  GridSlam slam(few());
  Walk walk;
  EXPECT_EQ(slam.fit(), 1.0) << "nothing says otherwise yet";
  for (int i = 0; i < 20; ++i, walk.step()) {
    slam.process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns);
    EXPECT_GT(slam.fit(), 0.95) << i;
  }
  walk.truth = Pose2{-2.5, 1.0, walk.truth.yaw + 2.0};  // carried there, which odometry does not see
  slam.process(test::roomScan(walk.truth), walk.odometry, walk.stamp_ns);
  EXPECT_LT(slam.fit(), 0.6) << "of two rooms' walls, some lie on one another";
  EXPECT_GE(slam.fit(), 0.0);
  slam.reset();
  EXPECT_EQ(slam.fit(), 1.0);
}

TEST(GridSlam, StartsAnew) {
  GridSlam slam(few());
  slam.process(test::roomScan({}), {}, 1);
  slam.reset();
  EXPECT_FALSE(slam.best().path);
  EXPECT_EQ(slam.process(test::roomScan({1, 0, 0}), {1, 0, 0}, 2), GridSlam::Outcome::kProcessed);
  EXPECT_EQ(slam.pose().x, 1.0);
  GridSlamParams bad;
  bad.particles = 0;
  EXPECT_THROW(GridSlam{bad}, std::invalid_argument);
}

TEST(GridSlam, GoesOnInAMapThatWasThere) {
  GridSlam first(few());
  Walk walk;
  for (int i = 0; i < 10; ++i, walk.step()) first.process(test::roomScan(walk.truth), walk.truth, walk.stamp_ns);
  GridSlam slam(few());
  const Eigen::Vector3d variances(0.25, 0.25, 0.03);
  slam.reset(first.best().map, {walk.truth * Pose2{0.15, -0.1, 0.08}, variances.asDiagonal()});
  const Pose2 T_map_odom{5.0, 2.0, 1.0};  // its odometry begins somewhere else
  slam.process(test::roomScan(walk.truth), inverse(T_map_odom) * walk.truth, 1);
  EXPECT_LT((slam.pose().position() - walk.truth.position()).norm(), 0.03);
  EXPECT_LT(std::abs(angleDifference(slam.pose().yaw, walk.truth.yaw)), 0.01);
}

TEST(GridSlam, MemoryFollowsTheAreaNotTheTime) {
  GridSlamParams params = few();
  params.particles = 3, params.path_length = 400;
  GridSlam slam(params);
  Walk walk;
  const auto held = [&slam](std::size_t& nodes) {  // tiles and nodes of the path of all particles, shared ones once
    std::set<const void*> tiles, path;
    for (const auto& p : slam.particles()) {
      p.map.forEach([&](TilePlace, const Tile& tile, const NearestField*) { tiles.insert(&tile); });
      for (const PathNode* n = p.path.get(); n; n = n->before.get()) path.insert(n);
    }
    nodes = path.size();
    return tiles.size();
  };
  std::size_t early = 0, late = 0, nodes = 0;
  for (int i = 0; i < 1600; ++i, walk.step()) {  // some twenty times round
    slam.process(test::roomScan(walk.truth, 90), walk.odometry, walk.stamp_ns);
    if (i == 200) early = held(nodes);
  }
  late = held(nodes);
  EXPECT_LE(late, early + early / 4);
  EXPECT_LE(nodes, 3u * 600u) << "path_length, and half of it until the next cut";
}

/// A corridor 3 m wide with a niche of 1 m every 7 m on its left: [m] to its walls, none beyond 30 m.
double corridorRange(const Pose2& at, double angle) {
  for (double range = 0.0; range < 30.0; range += 0.01) {
    const double x = at.x + range * std::cos(angle), y = at.y + range * std::sin(angle);
    const bool niche = std::fmod(x + 700.0, 7.0) < 1.0;
    if (y < -1.5 || y > (niche ? 2.0 : 1.5)) return range;
  }
  return HUGE_VAL;
}

TEST(GridSlam, GoesPastAKilometre) {
  GridSlamParams params = few();
  params.particles = 1, params.motion = {0.0, 0.0, 0.0, 0.0};  // odometry is exact and said to be: this is of the map
  GridSlam slam(params);
  const Tile* first = nullptr;
  Pose2 at;
  for (int i = 0; i <= 260; ++i, at.x += 4.0) {
    Scan scan;
    scan.angle_min = radians(-90.0), scan.angle_increment = radians(2.0), scan.range_max = 40.0;
    for (int k = 0; k < 91; ++k) scan.ranges.push_back(static_cast<float>(corridorRange(at, scan.angle(k))));
    slam.process(slamScan(scan, Transform::Identity(), {0.0, 40.0, 80.0}), at, std::int64_t{1'000'000'000} * i);
    if (i == 20) first = slam.best().map.tile({0, 0});
  }
  at.x -= 4.0;
  EXPECT_GT(at.x, 1000.0);
  EXPECT_GT(slam.pose().x, 1000.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(slam.best().map.tile({0, 0}), first) << "what is left behind stays where it is";
  const auto tileOf = [](double metres) { return static_cast<int>(std::floor(metres / 0.05)) >> kTileBits; };
  EXPECT_TRUE(slam.best().map.tile({tileOf(slam.pose().x), tileOf(slam.pose().y)}));
}

TEST(SlamPath, ForgetsALongPastWithoutRecursion) {
  PathNode::Pointer path;
  for (int i = 0; i < 1'000'000; ++i) path = new PathNode({i, {}}, std::move(path));
  path.reset();
}

}  // namespace
}  // namespace field_fusion::core
