#include "field_fusion/core/map/grid_slam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

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
      EXPECT_EQ(std::memcmp(tile.cells.data(), b.map.tile(place)->cells.data(), sizeof tile.cells), 0);
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

TEST(SlamPath, ForgetsALongPastWithoutRecursion) {
  PathNode::Pointer path;
  for (int i = 0; i < 1'000'000; ++i) path = new PathNode({i, {}}, std::move(path));
  path.reset();
}

}  // namespace
}  // namespace field_fusion::core
