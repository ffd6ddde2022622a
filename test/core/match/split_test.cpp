#include "field_fusion/core/match/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::personAt;
using test::seenBy;
using test::Solid;

const Transform kCamera = test::lookingAhead({0.2, 0.1, 0.3});

class SplitterTest : public testing::Test {
 protected:
  SplitterTest() {
    Gate gate;
    gate.setParams({}, 0.03, radians(0.5));
    splitter_.setParams({5}, gate, radians(1.0));
  }
  void addCluster(const std::vector<Solid>& solids) {
    bodies_.push_back({test::scan(solids, points_), static_cast<int>(bodies_.size()), 0, {}});
  }
  CameraTarget& addTarget(const Solid& solid) {
    view_.targets.push_back(seenBy(kCamera, solid, static_cast<int>(view_.targets.size()), 0.5));
    return view_.targets.back();
  }
  void split() { splitter_.run(bodies_, points_, view_); }
  bool whole() const { return bodies_.size() == 1 && bodies_[0].part == 0; }

  std::vector<Point> points_;
  std::vector<LidarTarget> bodies_;
  CameraView view_ = test::viewFrom(kCamera);
  Splitter splitter_;
};

// side by side, 0.4 m between them, joined by DBSCAN's epsilon of 0.5 m
TEST_F(SplitterTest, TwoPeopleInOneClusterBecomeTwoBodies) {
  const Solid left = personAt(6, 0.45), right = personAt(6, -0.45);
  addCluster({left, right});
  addTarget(left), addTarget(right);
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(bodies_[i].place, 0);
    EXPECT_EQ(bodies_[i].part, i + 1);
    const Solid& truth = i == 0 ? left : right;
    EXPECT_NEAR(bodies_[i].cluster.centre.y(), truth.centre().y(), 1e-5);
    EXPECT_NEAR(bodies_[i].cluster.box.sizes().y(), 0.5, 1e-5);
    EXPECT_NEAR(bodies_[i].cluster.polar.range, std::hypot(5.85, 0.45), 1e-5);
  }
  EXPECT_EQ(bodies_[0].members.size() + bodies_[1].members.size(), points_.size());
}

TEST_F(SplitterTest, EveryPointGoesToOnePart) {
  const Solid left = personAt(6, 0.24), right = personAt(6, -0.24);  // they touch, and the boxes overlap
  addCluster({left, right});
  addTarget(left), addTarget(right);
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  auto members = bodies_[0].members;
  members.insert(members.end(), bodies_[1].members.begin(), bodies_[1].members.end());
  std::sort(members.begin(), members.end());
  std::vector<std::uint32_t> all(points_.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(members, all);
}

TEST_F(SplitterTest, OneBoxLeavesItsClusterWhole) {
  addCluster({personAt(6, 0.2), personAt(6, -0.2)});
  addTarget(personAt(6, 0.2));
  split();
  EXPECT_TRUE(whole());
}

TEST_F(SplitterTest, OneBoxIsCutOutOfAClusterThatIsMuchWider) {
  const Solid person = personAt(6, 1.5);
  addCluster({person, {{6.3, -4, -1}, {6.5, 1.2, 1}}});  // a wall beside it
  addTarget(person);
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  EXPECT_NEAR(bodies_[0].cluster.centre.y(), 1.5, 0.1);
  EXPECT_NEAR(bodies_[0].cluster.box.sizes().y(), 0.5, 0.2);  // the margin takes some of the wall
  EXPECT_LT(bodies_[1].cluster.centre.y(), -1.0);
}

TEST_F(SplitterTest, ManyBoxesOnOneBodyEndSoon) {
  addCluster({{{6, -4, -1}, {6.5, 4, 1}}});
  for (int i = 0; i < 100; ++i) addTarget(personAt(6, -4 + 0.08 * i)).score = 0.01 * i;
  split();
  EXPECT_LE(bodies_.size(), 17u);
}

TEST_F(SplitterTest, TwoOpinionsOfOneBodyLeaveItWhole) {
  const Solid car{{6, -1, -1}, {10, 1, 0.5}};
  addCluster({car});
  addTarget(car);
  addTarget(car).score = 0.5;
  split();
  EXPECT_TRUE(whole());
}

TEST_F(SplitterTest, BoxThatHoldsTooFewPointsDoesNotSplit) {
  addCluster({personAt(6, 0)});
  addTarget(personAt(6, 0));
  addTarget(personAt(6, 0.62));  // beside it, where the LiDAR saw nothing
  split();
  EXPECT_TRUE(whole());
}

TEST_F(SplitterTest, BoxAtAnotherRangeDoesNotSplit) {
  addCluster({personAt(6, 0.45), personAt(6, -0.45)});
  addTarget(personAt(6, 0.45));
  CameraTarget& far = addTarget(personAt(6, -0.45));
  far.seen.range = 20.0;
  split();
  EXPECT_TRUE(whole());
}

TEST_F(SplitterTest, ClusterOfItsOwnIsLeftToTheBoxThatFitsIt) {
  addCluster({personAt(6, 0.45)});
  addCluster({personAt(6, -0.45)});
  addTarget(personAt(6, 0.45)), addTarget(personAt(6, -0.45));
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  EXPECT_EQ(bodies_[0].part + bodies_[1].part, 0);
}

TEST_F(SplitterTest, WhatNoBoxHoldsIsARestOfItsOwn) {
  const Solid left = personAt(6, 0.45), right = personAt(6, -0.45);
  addCluster({left, right, {{6, 0.9, -0.85}, {6, 2.5, 0.2}}});  // and a low wall
  addTarget(left), addTarget(right);
  split();
  ASSERT_EQ(bodies_.size(), 3u);
  EXPECT_EQ(bodies_[2].part, 3);
  EXPECT_NEAR(bodies_[2].cluster.box.max().y(), 2.5, 1e-5);
  EXPECT_GT(bodies_[2].cluster.box.min().y(), 0.75);
  EXPECT_NEAR(bodies_[1].cluster.centre.y(), -0.45, 1e-5);
}

TEST_F(SplitterTest, FewStrayPointsJoinTheNearestPart) {
  const Solid left = personAt(6, 0.45), right = personAt(6, -0.45);
  addCluster({left, right, {{6, 1.0, 0}, {6, 1.0, 0.1}}});
  addTarget(left), addTarget(right);
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  EXPECT_NEAR(bodies_[0].cluster.box.max().y(), 1.0, 1e-5);
}

TEST_F(SplitterTest, SecondCameraSplitsFurther) {
  const Solid a = personAt(6, 0.9), b = personAt(6, 0), c = personAt(6, -0.9);
  addCluster({a, b, c});
  addTarget(a), addTarget({b.low - Eigen::Vector3d(0, 0.9, 0), b.high});  // takes b and c for one
  split();
  ASSERT_EQ(bodies_.size(), 2u);
  view_.targets.clear();
  addTarget(b), addTarget(c);
  split();
  ASSERT_EQ(bodies_.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(bodies_[i].part, i + 1);
  EXPECT_NEAR(bodies_[2].cluster.centre.y(), -0.9, 1e-5);
}

TEST_F(SplitterTest, EmptyAndUnknownChangeNothing) {
  split();
  EXPECT_TRUE(bodies_.empty());
  addCluster({personAt(6, 0)});
  view_.targets.resize(2);  // all NaN
  split();
  EXPECT_TRUE(whole());
}

}  // namespace
}  // namespace field_fusion::core
