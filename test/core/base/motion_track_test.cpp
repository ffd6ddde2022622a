#include "field_fusion/core/base/motion_track.h"

#include <gtest/gtest.h>

#include <random>

#include "support/moving_scanner.h"

namespace field_fusion::core {
namespace {

constexpr double kStamp = 100.0;
const Sweep kSweep{0.0, 0.1};

Transform mount() {
  Transform out = Transform::Identity();
  out.translate(Eigen::Vector3d(0.3, -0.1, 0.5))
      .rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 3).normalized()));
  return out;
}

/// The obvious way: both poses in full, without knots.
Transform exact(const PoseHistory& history, double time, double instant, const Transform& T_base_sensor) {
  const Transform at = history.at(kStamp + time).transform() * T_base_sensor;
  return (history.at(kStamp + instant).transform() * T_base_sensor).inverse() * at;
}

/// Largest difference of a place 20 m away, over the sweep.
double worst(MotionTrack& track, const PoseHistory& history, double instant, const Transform& T_base_sensor) {
  double out = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double time = kSweep.begin + (kSweep.end - kSweep.begin) * i / 1000;
    const Eigen::Vector3d far(12.0, -16.0, 1.0);
    const Eigen::Vector3d want = exact(history, time, instant, T_base_sensor) * far;
    out = std::max(out,
                   (want - (track.at(static_cast<float>(time)) * far.cast<float>()).cast<double>()).norm());
  }
  return out;
}

TEST(MotionTrack, IsTheFullTransformOfEveryInstant) {
  for (const double rate : {500.0, 47.0, 11.0})
    for (const double instant : {0.0, 0.05, 0.1, 0.0333}) {
      const auto history =
          test::historyOf([](double t) { return test::trot(t - kStamp); }, kStamp - 0.2, kStamp + 0.3, rate);
      MotionTrack track;
      track.follow(history, kStamp, kSweep, instant, mount());
      EXPECT_LT(worst(track, history, instant, mount()), 5e-5) << rate << " Hz, " << instant;
    }
}

TEST(MotionTrack, FastTurnsBetweenFewPosesStayExact) {
  const auto spin = test::steady({1, 0, 0}, {0, 1, 3}, radians(720.0));
  const auto history =
      test::historyOf([&](double t) { return spin(t - kStamp); }, kStamp - 0.1, kStamp + 0.2, 10.0);
  MotionTrack track;
  track.follow(history, kStamp, kSweep, 0.1, mount());
  EXPECT_LT(worst(track, history, 0.1, mount()), 5e-5);
}

TEST(MotionTrack, TimesInAnyOrderGiveTheSame) {
  const auto history = test::historyOf([](double t) { return test::trot(t - kStamp); }, kStamp, kStamp + 0.2);
  MotionTrack track;
  track.follow(history, kStamp, kSweep, 0.0, mount());
  std::vector<float> times;
  for (int i = 0; i < 500; ++i) times.push_back(2e-4f * static_cast<float>(i));
  std::vector<Eigen::Vector3f> in_order;
  const Eigen::Vector3f p(3, 4, 0);
  for (const float time : times) in_order.push_back(track.at(time) * p);
  std::mt19937 random(1);
  std::vector<std::size_t> order(times.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) EXPECT_EQ(track.at(times[i]) * p, in_order[i]);
}

TEST(MotionTrack, SweepOfNoLengthIsOnePose) {
  const auto history = test::historyOf([](double t) { return test::trot(t - kStamp); }, kStamp, kStamp + 0.2);
  MotionTrack track;
  track.follow(history, kStamp, {0.05, 0.05}, 0.05, mount());
  for (const float time : {-1.f, 0.05f, 1.f})
    EXPECT_TRUE((track.at(time) * Eigen::Vector3f(1, 2, 3)).isApprox(Eigen::Vector3f(1, 2, 3), 1e-6f));
}

TEST(MotionTrack, TimesOutsideTheSweepAreItsEnds) {
  const auto history = test::historyOf(test::steady({1, 0, 0}, {0, 0, 1}, 0.0), 0.0, 0.1);
  MotionTrack track;
  track.follow(history, 0.0, kSweep, 0.0, Transform::Identity());
  EXPECT_NEAR(track.at(-5.f).position.x(), 0.0, 1e-6);
  EXPECT_NEAR(track.at(5.f).position.x(), 0.1, 1e-6);
}

TEST(MotionTrack, ConstantVelocityInItsOwnFrameIsAnArc) {
  // 1 m/s ahead while turning by 2 rad/s: a circle of radius 0.5 m about (0, 0.5)
  MotionTrack track;
  track.keepOn({1, 0, 0}, {0, 0, 2}, {0.0, 1.0}, 0.0);
  for (const float time : {0.f, 0.25f, 0.5f, 1.f}) {
    const double angle = 2.0 * time;
    const Eigen::Vector3f want(0.5f * static_cast<float>(std::sin(angle)),
                               0.5f - 0.5f * static_cast<float>(std::cos(angle)), 0.f);
    EXPECT_LT((track.at(time).position - want).norm(), 2e-5f) << time;
  }
}

TEST(MotionTrack, KeptOnIsTheSumOfManySmallSteps) {
  const Eigen::Vector3d velocity(1.0, -0.5, 0.2), turn(0.3, 2.0, -1.0);
  Transform sum = Transform::Identity();
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    Transform step = Transform::Identity();
    step.translation() = velocity / kSteps;
    step.linear() = Eigen::AngleAxisd(turn.norm() / kSteps, turn.normalized()).toRotationMatrix();
    sum = sum * step;
  }
  EXPECT_TRUE(keptOn(velocity, turn, 1.0).isApprox(sum, 1e-4));
  EXPECT_TRUE(keptOn(velocity, Eigen::Vector3d::Zero(), 2.0).translation().isApprox(2.0 * velocity));
  EXPECT_TRUE(keptOn(velocity, turn, -1.0).isApprox(keptOn(velocity, turn, 1.0).inverse(), 1e-12));
}

}  // namespace
}  // namespace field_fusion::core
