#include "field_fusion/core/base/inertial.h"

#include <gtest/gtest.h>

#include <functional>

namespace field_fusion::core {
namespace {

constexpr double kGravity = 9.80665, kRate = 200.0;
const Eigen::Vector3d kUp(0, 0, kGravity);

TimedPose feed(Inertial& inertial, double begin, double end,
               const std::function<Eigen::Vector3d(double)>& rate,
               const std::function<Eigen::Vector3d(double)>& force) {
  TimedPose out;
  for (int i = 0; begin + i / kRate <= end + 1e-9; ++i) {
    const double t = begin + i / kRate;
    out = inertial.add(t, rate(t), force(t));
  }
  return out;
}

const auto kNoTurn = [](double) { return Eigen::Vector3d(0, 0, 0); };
const auto kAtRest = [](double) { return kUp; };

double yaw(const TimedPose& pose) {
  const Eigen::Vector3d ahead = pose.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

TEST(Inertial, AtRestItStays) {
  Inertial inertial;
  const auto pose = feed(inertial, 0.0, 5.0, kNoTurn, kAtRest);
  EXPECT_LT(pose.position.norm(), 1e-9);
  EXPECT_LT(pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
}

TEST(Inertial, TurnIsTheIntegralOfTheRate) {
  Inertial inertial;
  const auto swing = [](double t) { return Eigen::Vector3d(0, 0, 2.0 * std::sin(3.0 * t)); };
  const auto pose = feed(inertial, 0.0, 1.0, swing, kAtRest);
  EXPECT_NEAR(yaw(pose), 2.0 / 3.0 * (1.0 - std::cos(3.0)), 1e-3);
}

TEST(Inertial, PlaceIsTheAccelerationIntegratedTwiceWhileItIsFresh) {
  // nearly no fading, nearly no righting: 0.5 m/s^2 for 0.4 s is 0.04 m
  InertialParams params;
  params.velocity_time = params.gravity_time = 1000.0;
  Inertial inertial(params);
  feed(inertial, 0.0, 0.1, kNoTurn, kAtRest);
  const auto push = [](double) { return Eigen::Vector3d(0.5, 0, kGravity); };
  const auto pose = feed(inertial, 0.1 + 1 / kRate, 0.5, kNoTurn, push);
  EXPECT_NEAR(pose.position.x(), 0.04, 1e-3);
}

TEST(Inertial, BiasOfTheAccelerometerDoesNotRunAway) {
  Inertial inertial;
  const auto tilted = [](double) { return Eigen::Vector3d(0.7, 0, kGravity); };  // 70 mg
  feed(inertial, 0.0, 0.1, kNoTurn, kAtRest);
  feed(inertial, 0.1 + 1 / kRate, 60.0, kNoTurn, tilted);
  const auto before = feed(inertial, 60.0 + 1 / kRate, 60.1, kNoTurn, tilted).position;
  const auto after = feed(inertial, 60.1 + 1 / kRate, 60.2, kNoTurn, tilted).position;
  EXPECT_LT((after - before).norm(), 0.005);
}

TEST(Inertial, StartsLevelHoweverItIsMounted) {
  // x up: the force is along x, and a turn about it is a yaw
  Inertial inertial;
  const auto along_x = [](double) { return Eigen::Vector3d(kGravity, 0, 0); };
  const auto pose = feed(inertial, 0.0, 0.2, kNoTurn, along_x);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT(pose.position.norm(), 1e-9);
}

TEST(Inertial, LearnsTheBiasOfTheGyroscopeAtRestAndNotOnTheMove) {
  const Eigen::Vector3d bias(0.01, -0.02, 0.015);
  Inertial inertial;
  feed(
      inertial, 0.0, 1.2, [&](double) { return bias; }, kAtRest);
  EXPECT_LT((inertial.bias() - bias).norm(), 1e-9);
  const auto shaken = [&](double t) {
    return Eigen::Vector3d(bias + Eigen::Vector3d(0, 0, 0.3 * std::sin(10 * t)));
  };
  feed(inertial, 1.2 + 1 / kRate, 5.0, shaken, kAtRest);
  EXPECT_LT((inertial.bias() - bias).norm(), 1e-9);
  InertialParams never;
  never.still_time = 0.0;
  Inertial deaf(never);
  feed(
      deaf, 0.0, 1.2, [&](double) { return bias; }, kAtRest);
  EXPECT_EQ(deaf.bias().norm(), 0.0);
}

TEST(Inertial, AfterSilenceItGoesOnWhereItWasWithoutSpeed) {
  Inertial inertial;
  const auto push = [](double) { return Eigen::Vector3d(2.0, 0, kGravity); };
  feed(inertial, 0.0, 0.1, kNoTurn, kAtRest);
  const auto moving = feed(inertial, 0.1 + 1 / kRate, 0.3, kNoTurn, push);
  const auto after = inertial.add(5.0, Eigen::Vector3d::Zero(), kUp);
  EXPECT_EQ(after.position, moving.position);
  EXPECT_EQ(after.time, 5.0);
  const auto next = inertial.add(5.005, Eigen::Vector3d::Zero(), moving.rotation.conjugate() * kUp);
  EXPECT_LT((next.position - after.position).norm(), 1e-4);
}

TEST(Inertial, DamagedSamplesAreNamed) {
  Inertial inertial;
  const Eigen::Vector3d nan(0, std::nan(""), 0);
  EXPECT_THROW(inertial.add(0.0, nan, kUp), std::runtime_error);
  EXPECT_THROW(inertial.add(0.0, Eigen::Vector3d::Zero(), nan), std::runtime_error);
  inertial.add(0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());  // free fall
  EXPECT_TRUE(
      inertial.add(0.01, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()).rotation.coeffs().allFinite());
}

}  // namespace
}  // namespace field_fusion::core
