#include "field_fusion/core/sim/odometry.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace field_fusion::core::sim {
namespace {

double yawOf(const Transform& pose) { return std::atan2(pose(1, 0), pose(0, 0)); }

/// Along y at 5 m/s: `length` m.
Trajectory straight(double length, const Shake& shake = {}) {
  Trajectory::Limits limits;
  limits.speed = 5.0;
  limits.acceleration = 5.0;
  return Trajectory({{{3, 0, 0}, kNaN, 0.0}, {{3, length, 0}, kNaN, 0.0}}, limits, shake);
}

Trajectory square() {
  Trajectory::Limits limits;
  limits.loop = true;
  return Trajectory(
      {{{0, 0, 0}, kNaN, 0.0}, {{4, 0, 0}, kNaN, 0.0}, {{4, 4, 0}, kNaN, 0.0}, {{0, 4, 0}, kNaN, 0.0}},
      limits);
}

Shake gait() {
  Shake shake;
  shake.terms.resize(1);
  shake.terms[0].amplitude << radians(2), radians(1), 0, 0, 0.005, 0.01;
  shake.terms[0].frequency = 2.0;
  return shake;
}

template <class Odometry>
OdometrySample atEnd(Odometry odometry, double rate, double seconds) {
  OdometrySample last;
  for (int i = 0; i <= seconds * rate; ++i) last = odometry.next();
  return last;
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

template <class Value>
Spread over(int seeds, Value value) {
  double sum = 0.0, squares = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const double v = value(static_cast<std::uint64_t>(seed));
    sum += v, squares += v * v;
  }
  return {sum / seeds, std::sqrt(squares / seeds - sum * sum / (seeds * seeds))};
}

WheelOdometryParams perfectWheels() { return {50.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }

LegOdometryParams perfectLegs(double rate = 100.0) {
  return {rate, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 8.0};
}

TEST(WheelOdometry, WithoutErrorsItIsTheWayFromItsStart) {
  const Trajectory way = square();
  WheelOdometry odometry(perfectWheels(), way, 1);
  const Transform T_start_world = way.pose(0).inverse();
  for (int i = 0; i < 1500; ++i) {
    const OdometrySample sample = odometry.next();
    const Transform truth = T_start_world * way.pose(sample.time);
    ASSERT_LT((sample.T_odom_base.translation() - truth.translation()).norm(), 2e-3) << sample.time;
    ASSERT_NEAR(angleDifference(yawOf(sample.T_odom_base), yawOf(truth)), 0.0, 1e-9);
  }
}

TEST(WheelOdometry, StandingStillItStaysAtItsStart) {
  const OdometrySample last = atEnd(WheelOdometry({}, Trajectory({{{5, 6, 0}, 1.0, 0.0}}, {}), 3), 50, 20);
  EXPECT_TRUE(last.T_odom_base.isApprox(Transform::Identity(), 1e-12));
  EXPECT_EQ(last.velocity, Eigen::Vector3d::Zero());
}

TEST(WheelOdometry, DriftGrowsAsConfigured) {
  const Trajectory way = straight(100);
  WheelOdometryParams params = perfectWheels();
  params.scale_error = 2.0;
  const Spread along = over(300, [&](std::uint64_t seed) {
    return atEnd(WheelOdometry(params, way, seed), 50, 22).T_odom_base.translation().x() - 100;
  });
  EXPECT_NEAR(along.deviation, 2.0, 0.25);  // 2 % of 100 m
  EXPECT_NEAR(along.mean, 0.0, 0.4);
  params = perfectWheels();
  params.yaw_noise = 0.5;
  const Spread yaw = over(300, [&](std::uint64_t seed) {
    return degrees(yawOf(atEnd(WheelOdometry(params, way, seed), 50, 22).T_odom_base));
  });
  EXPECT_NEAR(yaw.deviation, 0.5 * 10, 0.6);  // sqrt(100 m) = 10
}

/// At a steady 5 m/s: strides of 2.5 m in 0.5 s.
TEST(WheelOdometry, TellsTheErrorsToExpectOfItsRates) {
  const Trajectory way = straight(100);
  OdometrySample last;
  const auto at = [&](std::uint64_t seed) { return last = atEnd(WheelOdometry({}, way, seed), 50, 3); };
  const double velocity = std::hypot(0.01 * 5, 0.005 * std::sqrt(2.5) / 0.5);
  const double turn = std::hypot(0.1 * 5, 0.2 * std::sqrt(2.5) / 0.5);  // [deg/s]
  const Spread speeds = over(400, [&](std::uint64_t seed) { return at(seed).velocity.x(); });
  EXPECT_NEAR(speeds.deviation, velocity, 0.14 * velocity);  // four deviations of it
  EXPECT_NEAR(last.sigma_velocity.x(), velocity, 0.05 * velocity);
  const Spread turns = over(400, [&](std::uint64_t seed) { return degrees(at(seed).angular_rate.z()); });
  EXPECT_NEAR(turns.deviation, turn, 0.14 * turn);
  EXPECT_NEAR(degrees(last.sigma_angular_rate.z()), turn, 0.05 * turn);
  for (const double sigma : {last.sigma_height, last.sigma_tilt, last.sigma_velocity.y(), last.sigma_velocity.z(),
                             last.sigma_angular_rate.x(), last.sigma_angular_rate.y()})
    EXPECT_TRUE(std::isnan(sigma));  // it does not see them
}

TEST(WheelOdometry, RefusesARateOfZero) {
  WheelOdometryParams params;
  params.rate = 0;
  EXPECT_THROW(WheelOdometry(params, Trajectory(), 1), std::invalid_argument);
}

TEST(LegOdometry, WithoutErrorsItFollowsTheGaitToo) {
  const Trajectory way = straight(20, gait());
  LegOdometry odometry(perfectLegs(), way, 1);
  const Transform start = way.pose(0);
  for (int i = 0; i < 500; ++i) {
    const OdometrySample sample = odometry.next();
    const Eigen::Matrix3d level = Eigen::AngleAxisd(-yawOf(start), Eigen::Vector3d::UnitZ()).matrix();
    const Transform truth =
        Transform(level) * Eigen::Translation3d(-start.translation()) * way.pose(sample.time);
    ASSERT_TRUE(sample.T_odom_base.isApprox(truth, 1e-9)) << sample.time;
  }
}

TEST(LegOdometry, StandingStillItStaysAtItsStart) {
  const OdometrySample last = atEnd(LegOdometry({}, Trajectory(), 3), 500, 5);
  EXPECT_TRUE(last.T_odom_base.isApprox(Transform::Identity(), 1e-12));
}

TEST(LegOdometry, NoiseGrowsWithTheRootOfTheDistance) {
  LegOdometryParams params = perfectLegs();
  params.distance_noise = 0.02;
  for (double length : {25.0, 100.0}) {
    const Trajectory way = straight(length);
    const Spread across = over(300, [&](std::uint64_t seed) {
      return atEnd(LegOdometry(params, way, seed), 100, way.duration() + 1).T_odom_base.translation().y();
    });
    EXPECT_NEAR(across.deviation, 0.02 * std::sqrt(length), 0.02 * std::sqrt(length) * 0.12);
  }
}

TEST(LegOdometry, SlipsComeWithTheDistance) {
  LegOdometryParams params = perfectLegs();
  params.slip_rate = 0.5;
  params.slip_yaw = 1.0;
  const Trajectory way = straight(100);
  const Spread yaw = over(300, [&](std::uint64_t seed) {
    return degrees(yawOf(atEnd(LegOdometry(params, way, seed), 100, 22).T_odom_base));
  });
  EXPECT_NEAR(yaw.deviation, std::sqrt(50.0), 0.9);  // 50 slips of 1 degree
}

TEST(LegOdometry, TellsTheErrorsToExpectOfItsRates) {
  const Trajectory way = straight(100);
  LegOdometryParams params;
  params.rate = 100;
  OdometrySample last;
  const auto at = [&](std::uint64_t seed) { return last = atEnd(LegOdometry(params, way, seed), 100, 3); };
  const double noise = 0.01 * std::sqrt(2.5) / 0.5, slips = std::sqrt(0.05 * 2.5) / 0.5;
  const Eigen::Vector3d velocity(std::hypot(0.01 * 5, noise, 0.03 * slips), std::hypot(noise, 0.03 * slips), noise);
  for (int axis = 0; axis < 3; ++axis) {
    const Spread spread = over(400, [&](std::uint64_t seed) { return at(seed).velocity[axis]; });
    EXPECT_NEAR(spread.deviation, velocity[axis], 0.2 * velocity[axis]) << axis;  // slips are rare and large
    EXPECT_NEAR(last.sigma_velocity[axis], velocity[axis], 0.05 * velocity[axis]) << axis;
  }
  const double turn = std::hypot(0.05 * 5, 0.1 * std::sqrt(2.5) / 0.5, 0.5 * slips);  // [deg/s]
  EXPECT_NEAR(degrees(last.sigma_angular_rate.z()), turn, 0.05 * turn);
  EXPECT_EQ(last.sigma_tilt, 0.0);
  EXPECT_EQ(last.sigma_angular_rate.head<2>(), Eigen::Vector2d::Zero());
  const Spread height = over(400, [&](std::uint64_t seed) { return at(seed).T_odom_base.translation().z(); });
  EXPECT_NEAR(height.deviation, last.sigma_height, 0.2 * last.sigma_height);
}

TEST(LegOdometry, ShakingIsNoDistance) {
  LegOdometryParams params = perfectLegs();
  params.distance_noise = 0.1;
  const Trajectory standing({{{0, 0, 0}, 0.0, 0.0}}, {}, gait());
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    EXPECT_LT(atEnd(LegOdometry(params, standing, seed), 100, 60).T_odom_base.translation().norm(), 0.03);
}

TEST(LegOdometry, ImpactsShakeTheAnswerOnlyWhileItWalks) {
  LegOdometryParams params = perfectLegs(500);
  params.vibration = 2.0;
  const Trajectory way = straight(20);
  LegOdometry odometry(params, way, 4);
  double worst = 0.0;
  for (int i = 0; i < 500 * 10; ++i) {
    const OdometrySample sample = odometry.next();
    const double off = std::abs(sample.T_odom_base.translation().z());
    if (sample.time > 1 && sample.time < 4) worst = std::max(worst, off);
    if (sample.time > way.duration() + 1.1) {
      EXPECT_EQ(off, 0.0) << sample.time;
    }
  }
  EXPECT_NEAR(worst, 2e-3, 1e-4);
}

TEST(LegOdometry, IsItsSeeds) {
  LegOdometry a({}, straight(20), 7), b({}, straight(20), 7), c({}, straight(20), 8);
  for (int i = 0; i < 1000; ++i) {
    const auto first = a.next().T_odom_base.matrix(), same = b.next().T_odom_base.matrix();
    const auto other = c.next().T_odom_base.matrix();
    ASSERT_EQ(first, same);
    if (i > 500) {
      ASSERT_NE(first, other);
    }
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
