#include "field_fusion/core/base/pose_history.h"

#include <gtest/gtest.h>

#include "support/moving_scanner.h"

namespace field_fusion::core {
namespace {

using Cover = PoseHistory::Cover;

TimedPose poseAt(double time, double x = 0.0, double yaw = 0.0) {
  return {time, {x, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()))};
}

PoseHistory steps(std::initializer_list<double> times) {
  PoseHistory out;
  for (const double time : times) out.add(poseAt(time, time));
  return out;
}

std::string damageOf(const TimedPose& pose) {
  PoseHistory history;
  try {
    history.add(pose);
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(history.size(), 0u);
    return e.what();
  }
  return "";
}

TEST(PoseHistory, PlaceIsLinearAndRotationOfConstantRateBetweenTwoPoses) {
  PoseHistory history;
  history.add({10.0, {1, 2, 3}, Eigen::Quaterniond::Identity()});
  history.add(
      {10.1, {2, 0, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 1, 0).normalized()))});
  const TimedPose quarter = history.at(10.025);
  EXPECT_TRUE(quarter.position.isApprox(Eigen::Vector3d(1.25, 1.5, 3.0), 1e-9));
  const Eigen::AngleAxisd turn(quarter.rotation);
  EXPECT_NEAR(turn.angle(), 0.25, 1e-6);
  EXPECT_TRUE(turn.axis().isApprox(Eigen::Vector3d(1, 1, 0).normalized(), 1e-9));
}

TEST(PoseHistory, QuaternionsOfOppositeSignAreTheSameRotation) {
  PoseHistory history;
  history.add(poseAt(0.0, 0.0, 0.1));
  TimedPose turned = poseAt(0.1, 0.0, 0.3);
  turned.rotation.coeffs() *= -1.0;
  history.add(turned);
  EXPECT_NEAR(Eigen::AngleAxisd(history.at(0.05).rotation).angle(), 0.2, 1e-9);
}

TEST(PoseHistory, PosesThemselvesAndBothEndsAreExact) {
  const PoseHistory history = steps({1.0, 1.05, 1.1});
  for (const double time : {1.0, 1.05, 1.1}) EXPECT_DOUBLE_EQ(history.at(time).position.x(), time);
  EXPECT_THROW(history.at(0.99), std::out_of_range);
  EXPECT_THROW(history.at(1.11), std::out_of_range);
  EXPECT_THROW(history.at(std::nan("")), std::out_of_range);
  EXPECT_THROW(PoseHistory().at(1.0), std::out_of_range);
}

TEST(PoseHistory, TellsWhatItCannotTell) {
  const PoseHistory history = steps({1.0, 1.1, 1.2});
  EXPECT_EQ(history.cover(1.0, 1.2), Cover::kWhole);
  EXPECT_EQ(history.cover(1.2, 1.2), Cover::kWhole);
  EXPECT_EQ(history.cover(1.15, 1.25), Cover::kNotYet);
  EXPECT_EQ(history.cover(0.95, 1.05), Cover::kBegun) << "what is before the first will never come";
  EXPECT_EQ(history.cover(0.95, 1.3), Cover::kBegun);
  EXPECT_EQ(PoseHistory().cover(1.0, 1.1), Cover::kNotYet);
}

TEST(PoseHistory, GapCountsOnlyWhereItIsAsked) {
  const PoseHistory history = steps({1.0, 1.05, 1.4, 1.45});
  EXPECT_EQ(history.cover(1.0, 1.05), Cover::kWhole);
  EXPECT_EQ(history.cover(1.02, 1.1), Cover::kGap);
  EXPECT_EQ(history.cover(1.1, 1.2), Cover::kGap);
  EXPECT_EQ(history.cover(1.25, 1.42), Cover::kGap);
  EXPECT_EQ(history.cover(1.4, 1.45), Cover::kWhole);
}

TEST(PoseHistory, LeapOfPlaceOrRotationIsNotInterpolated) {
  PoseHistory place, rotation;
  place.add(poseAt(1.0)), place.add(poseAt(1.02, 50.0));
  EXPECT_EQ(place.cover(1.0, 1.01), Cover::kLeap);
  rotation.add(poseAt(1.0)), rotation.add(poseAt(1.02, 0.0, 3.0));
  EXPECT_EQ(rotation.cover(1.0, 1.01), Cover::kLeap);
}

TEST(PoseHistory, NoiseOfTwoPosesThatLieCloseIsNoLeap) {
  PoseHistory history;
  history.add(poseAt(1.0)), history.add(poseAt(1.0 + 1e-6, 0.01));
  EXPECT_EQ(history.cover(1.0, 1.0 + 1e-6), Cover::kWhole);
}

TEST(PoseHistory, NotNewerIsLeftOut) {
  PoseHistory history = steps({1.0, 1.1});
  EXPECT_FALSE(history.add(poseAt(1.05, 7.0)));
  EXPECT_FALSE(history.add(poseAt(1.1, 7.0)));
  EXPECT_DOUBLE_EQ(history.at(1.05).position.x(), 1.05);
}

TEST(PoseHistory, AfterClearItTakesEarlierTimes) {
  PoseHistory history = steps({100.0, 100.1});
  history.clear();
  EXPECT_TRUE(history.add(poseAt(1.0)));
  EXPECT_EQ(history.cover(1.0, 100.05), Cover::kNotYet);
}

TEST(PoseHistory, DamagedPosesAreNamedAndNotKept) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  TimedPose pose = poseAt(1.0);
  pose.rotation.coeffs()[1] = nan;
  EXPECT_EQ(damageOf(pose), "pose damaged: a number is not finite");
  pose = poseAt(1.0, inf);
  EXPECT_EQ(damageOf(pose), "pose damaged: a number is not finite");
  EXPECT_EQ(damageOf(poseAt(nan)), "pose damaged: a number is not finite");
  pose = poseAt(1.0);
  pose.rotation.coeffs().setZero();
  EXPECT_EQ(damageOf(pose).find("pose damaged: a quaternion of length 0"), 0u);
  pose.rotation.coeffs() << 0, 0, 0, 1.01;
  EXPECT_NE(damageOf(pose), "");
  pose.rotation.coeffs() << 0, 0, 0, 1.0001;
  EXPECT_EQ(damageOf(pose), "") << "as float32 in a driver rounds";
}

TEST(PoseHistory, FullRingForgetsTheOldest) {
  PoseHistory history({}, 16);
  for (int i = 0; i < 100; ++i) history.add(poseAt(0.01 * i, i));
  EXPECT_EQ(history.size(), 16u);
  EXPECT_DOUBLE_EQ(history[0].position.x(), 84.0);
  EXPECT_NEAR(history.at(0.905).position.x(), 90.5, 1e-9);
  EXPECT_EQ(history.cover(0.83, 0.9), Cover::kBegun);
  EXPECT_EQ(history.firstAfter(0.99), 16u);
  EXPECT_EQ(history.firstAfter(0.5), 0u);
}

TEST(PoseHistory, ImpossibleParametersAreRefused) {
  PoseHistoryParams params;
  params.max_gap = -1.0;
  EXPECT_THROW(PoseHistory{params}, std::invalid_argument);
  EXPECT_THROW(PoseHistory({}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
