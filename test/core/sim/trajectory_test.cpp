#include "field_fusion/core/sim/trajectory.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

using WayPoint = Trajectory::WayPoint;

double yawOf(const Transform& pose) { return std::atan2(pose(1, 0), pose(0, 0)); }

Trajectory::Limits limits(double speed, double acceleration, bool loop = false) {
  Trajectory::Limits out;
  out.speed = speed;
  out.acceleration = acceleration;
  out.loop = loop;
  return out;
}

WayPoint at(double x, double y, double yaw = kNaN, double pause = 0.0) { return {{x, y, 0.0}, yaw, pause}; }

TEST(Trajectory, StandsAtASingleWayPoint) {
  const Trajectory way({at(1, 2, 0.5)}, {});
  EXPECT_TRUE(way.still());
  EXPECT_EQ(way.duration(), 0.0);
  EXPECT_EQ(way.pose(-3).translation(), Eigen::Vector3d(1, 2, 0));
  EXPECT_NEAR(yawOf(way.pose(100)), 0.5, 1e-12);
  EXPECT_TRUE(Trajectory().pose(1).isApprox(Transform::Identity()));
}

TEST(Trajectory, AStraightIsATrapezoidOfSpeed) {
  const Trajectory way({at(0, 0), at(0, 10)}, limits(2.0, 1.0));  // 2 s rise, 2 m; 3 s steady, 6 m; 2 s fall
  EXPECT_NEAR(way.duration(), 7.0, 1e-12);
  EXPECT_NEAR(way.pose(1).translation().y(), 0.5, 1e-12);
  EXPECT_NEAR(way.pose(3.5).translation().y(), 5.0, 1e-12);
  EXPECT_NEAR(way.pose(6).translation().y(), 9.5, 1e-12);
  EXPECT_NEAR(way.pose(99).translation().y(), 10.0, 1e-12);
  EXPECT_NEAR(yawOf(way.pose(0)), radians(90), 1e-12);
  EXPECT_TRUE(way.velocity(3.5).isApprox(Eigen::Vector3d(2, 0, 0), 1e-9));  // in the body's frame
}

TEST(Trajectory, AShortStraightNeverReachesItsSpeed) {
  const Trajectory way({at(0, 0), at(1, 0)}, limits(10.0, 1.0));
  EXPECT_NEAR(way.duration(), 2.0, 1e-12);
  EXPECT_NEAR(way.velocity(1.0).norm(), 1.0, 1e-3);
}

TEST(Trajectory, TurnsOnTheSpotThenPauses) {
  auto limit = limits(1, 1);
  limit.turn_rate = radians(90);
  const Trajectory way({at(0, 0, 0.0), at(0, 0, radians(90), 2.0)}, limit);
  EXPECT_NEAR(way.duration(), 1.5 + 2.0, 1e-9);  // 0.5 s to the full rate, 0.5 s steady, 0.5 s to rest
  EXPECT_NEAR(yawOf(way.pose(0.75)), radians(45), 1e-9);
  EXPECT_NEAR(way.angularVelocity(0.75).z(), radians(90), 1e-6);
  EXPECT_NEAR(yawOf(way.pose(1.5)), radians(90), 1e-9);
  EXPECT_LT(way.pose(0.75).translation().norm(), 1e-12);
}

TEST(Trajectory, AReversalIsStoppedAt) {
  const Trajectory way({at(0, 0), at(4, 0), at(0, 0)}, limits(1, 1));
  EXPECT_NEAR(way.pose(5).translation().x(), 4.0, 1e-12);
  EXPECT_NEAR(way.velocity(5.0).norm(), 0.0, 1e-3);
  EXPECT_NEAR(std::abs(yawOf(way.pose(way.duration()))), radians(180), 1e-9);
}

TEST(Trajectory, ACornerIsCutByNoMoreThanAllowed) {
  auto limit = limits(5, 1);
  limit.turn_rate = 100;
  limit.corner = 0.4;
  const Trajectory way({at(0, 0), at(20, 0), at(20, 20)}, limit);
  double nearest = 1e9;
  for (double t = 0; t < way.duration(); t += 1e-3)
    nearest = std::min(nearest, (way.pose(t).translation() - Eigen::Vector3d(20, 0, 0)).norm());
  EXPECT_NEAR(nearest, 0.4, 1e-4);
}

TEST(Trajectory, LoopsComeBackWithTheSameStep) {
  const Trajectory way({at(0, 0), at(6, 0), at(6, 6), at(0, 6)}, limits(1, 0.5, true));
  EXPECT_LT((way.pose(way.duration()).translation() - way.pose(0).translation()).norm(), 1e-9);
  EXPECT_TRUE(way.pose(3.0).isApprox(way.pose(3.0 + 2 * way.duration()), 1e-9));
  EXPECT_TRUE(way.pose(way.duration() - 1e-7).isApprox(way.pose(0), 1e-6));
}

TEST(Trajectory, AnyWayIsContinuousAndKeepsItsLimits) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> place(-10, 10), unit(0, 1);
  for (int run = 0; run < 12; ++run) {
    std::vector<WayPoint> points;
    for (int i = 0; i < 8; ++i)
      points.push_back({{place(draw), place(draw), 0.2 * place(draw)},
                        unit(draw) < 0.2 ? place(draw) : kNaN,
                        unit(draw) < 0.2 ? 1.0 : 0.0});
    auto limit = limits(0.2 + 3 * unit(draw), 0.2 + unit(draw), run % 2);
    limit.turn_rate = 0.5 + unit(draw);
    limit.corner = unit(draw);
    const Trajectory way(points, limit);
    constexpr double kStep = 1e-3;
    for (double t = -0.1; t < 1.3 * way.duration(); t += kStep) {
      const Eigen::Vector3d a = way.pose(t - kStep).translation(), b = way.pose(t).translation(),
                            c = way.pose(t + kStep).translation();
      ASSERT_LE((c - b).norm(), limit.speed * kStep * (1 + 1e-6)) << run << " at " << t;
      ASSERT_LE((a - 2 * b + c).norm(), limit.acceleration * kStep * kStep * 1.01) << run << " at " << t;
      ASSERT_LE(std::abs(angleDifference(yawOf(way.pose(t + kStep)), yawOf(way.pose(t)))),
                limit.turn_rate * kStep * 1.01)
          << run << " at " << t;
    }
  }
}

TEST(Trajectory, ShakeIsAddedInTheBodysFrame) {
  Shake shake;
  shake.terms.resize(1);
  shake.terms[0].amplitude << radians(5), 0, 0, 0, 0.1, 0;
  shake.terms[0].frequency = 0.25;
  const Trajectory way({at(3, 0, radians(90))}, {}, shake);
  EXPECT_FALSE(way.still());
  EXPECT_TRUE(way.pose(0).translation().isApprox(Eigen::Vector3d(3, 0, 0)));
  const Transform top = way.pose(1.0);  // a quarter of its period: the body's left is the world's -x
  EXPECT_TRUE(top.translation().isApprox(Eigen::Vector3d(2.9, 0, 0)));
  EXPECT_NEAR(top.linear().col(1).z(), std::sin(radians(5)), 1e-12);
  EXPECT_NEAR(way.angularVelocity(0).x(), radians(5) * 2 * radians(180) * 0.25, 1e-6);
}

TEST(Trajectory, RefusesWhatIsNoWay) {
  EXPECT_THROW(Trajectory({}, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0)}, limits(0, 1)), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0)}, limits(1, -1)), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0)}, limits(kNaN, 1)), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(kNaN, 0)}, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0), at(1, 0), at(1, 0)}, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0), at(1, 0), at(0, 0)}, limits(1, 1, true)), std::invalid_argument);
  EXPECT_THROW(Trajectory({at(0, 0, kNaN, -1.0)}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
