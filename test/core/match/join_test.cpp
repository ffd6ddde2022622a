#include "field_fusion/core/match/join.h"

#include <gtest/gtest.h>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using test::Solid;

const Transform kCamera = test::lookingAhead({0.1, 0, -0.2});
/// Near rim, far rim and handrail of a cage of 4 m, 10 m ahead, and the box around them.
const Solid kNear{{8, -1.9, -1.3}, {8, 1.9, -1.2}}, kFar{{12, -1.8, -1.3}, {12, 1.8, -1.2}},
    kRail{{8.4, -1.6, -0.3}, {8.4, 1.6, -0.2}}, kCage{{8, -2, -1.3}, {12, 2, -0.2}};

class JoinerTest : public testing::Test {
 protected:
  JoinerTest() {
    Gate gate;
    gate.setParams({}, 0.03, radians(0.5));
    ShapeParams shapes;
    shapes.class_diameters = {{"cage", 4.0}, {"buoy", 0.8}};
    shapes.class_nets.clear();
    joiner_.setParams(shapes, gate, radians(1.0));
  }
  void addClusters(const std::vector<Solid>& solids) {
    for (const Solid& solid : solids)
      bodies_.push_back({test::scan({solid}, points_), static_cast<int>(bodies_.size()), 0, {}});
  }
  CameraTarget& addTarget(const Solid& solid, const std::string& label) {
    view_.targets.push_back(test::seenBy(kCamera, solid, static_cast<int>(view_.targets.size()), 1.0));
    view_.targets.back().label = label;
    return view_.targets.back();
  }
  void join() { joiner_.run(bodies_, points_, view_); }

  std::vector<Point> points_;
  std::vector<LidarTarget> bodies_;
  CameraView view_ = test::viewFrom(kCamera);
  Joiner joiner_;
};

TEST_F(JoinerTest, PiecesInOneBoxAreOneBody) {
  addClusters({kNear, kFar, kRail});
  addTarget(kCage, "cage");
  join();
  ASSERT_EQ(bodies_.size(), 1u);
  const LidarTarget& body = bodies_[0];
  EXPECT_EQ(body.part, 0);
  EXPECT_EQ(body.members.size(), points_.size());
  std::vector<int> places = body.joined;
  places.push_back(body.place);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places, (std::vector<int>{0, 1, 2}));
  EXPECT_NEAR(body.cluster.box.min().x(), 8.0, 1e-5);
  EXPECT_NEAR(body.cluster.box.max().x(), 12.0, 1e-5);
  EXPECT_NEAR(body.cluster.box.max().z(), -0.2, 1e-5);
}

TEST_F(JoinerTest, WhatStandsBehindOrBesideStaysABody) {
  const Solid behind{{15, -1, -1.0}, {15, 1, -0.6}}, beside{{10, 3, -1.3}, {10, 5, -0.2}};
  addClusters({kNear, kRail, behind, beside});
  addTarget(kCage, "cage");
  join();
  ASSERT_EQ(bodies_.size(), 3u);
  EXPECT_EQ(bodies_[1].place, 2);
  EXPECT_EQ(bodies_[2].place, 3);
  EXPECT_TRUE(bodies_[1].joined.empty() && bodies_[2].joined.empty());
}

// the smaller box has the first word
TEST_F(JoinerTest, ABuoyBeforeACageIsNoPartOfIt) {
  const Solid buoy{{7.6, -0.4, -1.3}, {7.6, 0.4, -0.3}};
  addClusters({kNear, buoy, kRail});
  addTarget(kCage, "cage");
  addTarget(buoy, "buoy");
  join();
  ASSERT_EQ(bodies_.size(), 2u);
  const auto& alone = bodies_[0].joined.empty() ? bodies_[0] : bodies_[1];
  EXPECT_EQ(alone.place, 1);
  EXPECT_TRUE(alone.joined.empty());
}

TEST_F(JoinerTest, AClassWithoutSizeJoinsNothing) {
  addClusters({kNear, kFar});
  addTarget(kCage, "pontoon");
  join();
  EXPECT_EQ(bodies_.size(), 2u);
}

TEST_F(JoinerTest, ABoxThatIsNotKnownJoinsNothing) {
  addClusters({kNear, kFar});
  addTarget(kCage, "cage").box = {};
  join();
  EXPECT_EQ(bodies_.size(), 2u);
}

TEST_F(JoinerTest, WithoutBodiesOrTargetsNothingHappens) {
  join();
  EXPECT_TRUE(bodies_.empty());
  addTarget(kCage, "cage");
  join();
  EXPECT_TRUE(bodies_.empty());
  view_.targets.clear();
  addClusters({kNear});
  join();
  EXPECT_EQ(bodies_.size(), 1u);
}

}  // namespace
}  // namespace field_fusion::core
