#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/shapes.h"
#include "test_world.h"

namespace field_fusion::core::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// From x = 0 to x = 100 at 2 m/s after a start of at most a second.
Trajectory run() {
  Trajectory::Limits limits;
  limits.speed = 2.0, limits.acceleration = 4.0;
  return Trajectory({{{0, 0, 0}, kNaN, 0}, {{100, 0, 0}, kNaN, 0}}, limits);
}

TEST(CasterMotion, MovingBodyIsWhereItIsAtTheRaysTime) {
  const World world = test::worldOf(Sphere{{0, 0, 1}, 0.5f}, run());
  Caster caster(world);
  caster.setWindow(10.0, 10.1);
  for (const float share : {0.f, 0.25f, 0.5f, 0.77f, 1.f}) {
    const double x = world.bodies[0].way.pose(10.0 + 0.1 * share).translation().x();
    const Hit hit = caster.cast({{-5, 0, 1}, {1, 0, 0}, share});
    EXPECT_NEAR(hit.range, x + 5.0 - 0.5, 2e-5 * x) << share;
  }
}

TEST(CasterMotion, EachWindowMovesAnew) {
  const World world = test::worldOf(Sphere{{0, 0, 1}, 0.5f}, run());
  Caster caster(world);
  for (const double begin : {20.0, 3.0, 0.0, 40.0}) {
    caster.setWindow(begin, begin);
    const double x = world.bodies[0].way.pose(begin).translation().x();
    EXPECT_NEAR(caster.cast({{-5, 0, 1}, {1, 0, 0}}).range, x + 4.5, 1e-5 * (x + 5)) << begin;
  }
}

TEST(CasterMotion, BodyThatStandsIsNotMoved) {
  const World world = test::worldOf(Sphere{{0, 0, 1}, 0.5f}, test::still({7, 0, 0}));
  Caster caster(world);
  caster.setWindow(5.0, 6.0);
  EXPECT_FLOAT_EQ(caster.cast({{0, 0, 1}, {1, 0, 0}, 0.5f}).range, 6.5f);
}

/// The chord between two instants leaves the arc of a body that shakes in yaw by less than 1 mm.
TEST(CasterMotion, TurningRobotStaysWithinAMillimetre) {
  Shake shake;
  shake.terms.resize(1);
  shake.terms[0].amplitude[5] = 0.5, shake.terms[0].frequency = 1.0;  // up to 180 degrees/s
  World world = test::worldOf(test::boxMesh({2, 2, 2}));
  world.bodies[0].way = Trajectory({{{0, 0, 0}, 0.0, 0}}, {}, shake);
  Caster caster(world);
  caster.setWindow(0.0, 0.5);
  for (int i = 0; i <= 100; ++i) {
    const float share = static_cast<float>(i) / 100.f;
    const Transform T = world.bodies[0].way.pose(0.5 * share);
    // along x of the body, from outside, at its corner's height
    const Vector3d from = T * Vector3d(10, 0.9, 1), along = T.linear() * Vector3d(-1, 0, 0);
    EXPECT_NEAR(caster.cast({from.cast<float>(), along.cast<float>(), share}).range, 9.0, 1e-3) << share;
  }
}

/// Rays from ahead at the height of a foot, against the pose of the shin.
TEST(CasterMotion, WalkingFootIsWithinAMillimetreOfItsJoint) {
  Model model;
  Joint joint;
  joint.pivot = {0, 0, 0.9}, joint.amplitude = 0.45, joint.period = 1.0;
  model.links.push_back({{{Shape(Sphere{{0, 0, 0.05f}, 0.05f}), {}}}, joint, -1});
  World world = test::worldOf(Sphere{{0, 0, 0}, 1});
  world.bodies[0].model = model;
  Caster caster(world);
  caster.setWindow(0.0, 0.1);
  for (int i = 0; i <= 50; ++i) {
    const float share = static_cast<float>(i) / 50.f;
    const Vector3d foot = model.linkPose(0, 0.1 * share) * Vector3d(0, 0, 0.05);
    const Vector3f from = (foot + Vector3d(3, 0, 0)).cast<float>();
    EXPECT_NEAR(caster.cast({from, {-1, 0, 0}, share}).range, 2.95, 1e-3) << share;
  }
}

TEST(CasterMotion, WalkersStepIsTheWayOfTheBodyAndFeetStayOnTheGround) {
  const double speed = 1.4;
  const Model model = makeShape("person", {{"speed", speed}});
  double lowest = 1.0;
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (double t = 0.0; t < 2.0; t += 0.01)
      for (const Part& part : model.links[i].parts)
        if (std::holds_alternative<Mesh>(part.shape))
          for (const Vector3f& v : std::get<Mesh>(part.shape).vertices)
            lowest = std::min(lowest, (model.linkPose(i, t) * v.cast<double>()).z());
  EXPECT_GT(lowest, -0.05);
  EXPECT_LT(lowest, 0.01);
  const std::size_t shin = 2;  // swings back with its thigh from a quarter of the period to three quarters
  const double period = model.links[shin].joint->period;
  const auto sole = [&](double t) { return (model.linkPose(shin, t) * Vector3d::Zero()).x(); };
  const double step = std::abs(sole(0.25 * period) - sole(0.75 * period));
  EXPECT_NEAR(step, 0.5 * period * speed, 0.08 * step);
}

TEST(CasterMotion, WindowThatEndsBeforeItBeginsIsRefused) {
  const World world = test::worldOf(Sphere{{0, 0, 1}, 0.5f});
  Caster caster(world);
  EXPECT_THROW(caster.setWindow(1.0, 0.5), std::invalid_argument);
  EXPECT_THROW(caster.setWindow(NAN, 0.5), std::invalid_argument);
}

TEST(CasterMotion, RobotMovesWithItsWay) {
  World world;
  world.ground.kind = Ground::Kind::kNone;
  world.robot.model.links.push_back({{{Shape(Sphere{{0, 0, 1}, 0.5f}), {}}}, {}, -1});
  world.robot.way = run();
  Caster caster(world);
  caster.setWindow(5.0, 5.1);
  const Hit hit = caster.cast({{-5, 0, 1}, {1, 0, 0}, 0.5f});
  EXPECT_EQ(hit.body, Hit::kRobot);
  EXPECT_NEAR(hit.range, world.robot.way.pose(5.05).translation().x() + 4.5, 1e-4);
}

}  // namespace
}  // namespace field_fusion::core::sim
