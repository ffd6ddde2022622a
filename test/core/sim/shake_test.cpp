// Shaking that belongs to walking or driving: it comes with the speed and goes with it.
#include <gtest/gtest.h>

#include "field_fusion/core/sim/imu.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kFull = 0.2;  // [m/s]
const double kTurn = 2 * radians(180.0);

/// Heaves by 10 mm and pitches by 1 degree, four times a second.
Shake gait(double full_speed = kFull) {
  Shake shake;
  shake.terms.resize(1);
  shake.terms[0].amplitude << 0, radians(1), 0, 0, 0, 0.01;
  shake.terms[0].frequency = 4.0;
  shake.full_speed = full_speed;
  return shake;
}

Trajectory ahead(double speed, const Shake& shake) {
  Trajectory::Limits limits;
  limits.speed = speed;
  return Trajectory({{{0, 0, 0}, kNaN, 0.0}, {{20 * speed, 0, 0}, kNaN, 0.0}}, limits, shake);
}

/// Largest heave in a quarter of a second, a period.
double heave(const Trajectory& way, double begin) {
  double most = 0.0;
  for (double t = begin; t < begin + 0.25; t += 1e-3) most = std::max(most, way.pose(t).translation().z());
  return most;
}

TEST(ShakeOfGait, IsNoneAtRest) {
  const Trajectory standing({{{1, 2, 3}, 0.5, 0.0}}, {}, gait());
  EXPECT_TRUE(standing.still());
  const Trajectory paused({{{0, 0, 0}, 0.0, 5.0}, {{1, 0, 0}, kNaN, 5.0}}, {}, gait());
  EXPECT_FALSE(paused.still());
  for (double t = 0; t < 4.8; t += 0.01) {  // the mean of the speed reaches 0.2 s ahead
    EXPECT_TRUE(standing.pose(t).isApprox(standing.pose(0), 1e-15));
    EXPECT_TRUE(paused.pose(t).isApprox(paused.pose(0), 1e-15)) << t;
  }
  EXPECT_GT(heave(paused, 5.5), 0.0);
  EXPECT_EQ(heave(paused, paused.duration() - 3.0), 0.0);
}

TEST(ShakeOfGait, AStandingInertialUnitFeelsGravityAlone) {
  const Trajectory standing({{{1, 2, 3}, 0.5, 0.0}}, {}, gait());
  const ImuSample sample = perfectImu(standing, Transform::Identity(), 3.21, 0.005);
  EXPECT_TRUE(sample.specific_force.isApprox(Eigen::Vector3d(0, 0, kGravity), 1e-9));
  EXPECT_NEAR(sample.angular_rate.norm(), 0.0, 1e-9);
}

TEST(ShakeOfGait, IsFullFromItsSpeedOnAndHalfAtHalfOfIt) {
  EXPECT_NEAR(heave(ahead(kFull, gait()), 8.0), 0.01, 1e-6);
  EXPECT_NEAR(heave(ahead(3 * kFull, gait()), 8.0), 0.01, 1e-6);
  EXPECT_NEAR(heave(ahead(kFull / 2, gait()), 8.0), 0.005, 1e-6);  // the fade is odd about its middle
  EXPECT_LT(heave(ahead(kFull / 10, gait()), 8.0), 0.0002);
}

TEST(ShakeOfGait, TurnsOnTheSpotAreWalked) {
  Trajectory::Limits limits;
  limits.turn_rate = 1.0;  // feet 0.3 m from the middle: 0.3 m/s
  const Trajectory turning({{{0, 0, 0}, 0.0, 0.0}, {{0, 0, 0}, 3.0, 0.0}}, limits, gait());
  EXPECT_NEAR(heave(turning, 1.2), 0.01, 1e-6);
}

TEST(ShakeOfWaves, IsFullAtRest) {
  const Trajectory standing({{{0, 0, 0}, 0.0, 0.0}}, {}, gait(0.0));
  EXPECT_FALSE(standing.still());
  EXPECT_NEAR(heave(standing, 1.0), 0.01, 1e-6);
}

/// A step of the velocity would make second differences grow as the step of time shrinks.
TEST(ShakeOfGait, FadesWithoutKnocks) {
  const Trajectory way({{{0, 0, 0}, 0.0, 1.0}, {{1, 0, 0}, kNaN, 0.0}, {{1, 1, 0}, kNaN, 1.0}}, {}, gait());
  const auto most = [&way](double step) {
    double most = 0.0;
    for (double t = 0; t < way.duration(); t += 1e-3) {
      const Eigen::Vector3d a = way.pose(t - step).translation(), b = way.pose(t).translation(),
                            c = way.pose(t + step).translation();
      most = std::max(most, (a - 2 * b + c).norm() / (step * step));
    }
    return most;
  };
  const double omega = kTurn * 4.0, coarse = most(2e-3);
  EXPECT_GT(coarse, 0.9 * 0.01 * omega * omega);
  EXPECT_NEAR(most(2e-4), coarse, 0.02 * coarse);
}

/// Velocities are those of the shaken way: summed up they lead to where it is.
TEST(ShakeOfGait, VelocityAndTurnRateBelongToThePose) {
  const Trajectory way = ahead(0.5, gait());
  constexpr double kStep = 1e-3;
  Transform T = way.pose(0.0);
  for (int i = 0; i < 5000; ++i) {
    const double t = (i + 0.5) * kStep;
    T.translation() += kStep * (way.pose(t).linear() * way.velocity(t));
    const Eigen::Vector3d turn = kStep * way.angularVelocity(t);
    T.linear() = T.linear() * Eigen::AngleAxisd(turn.norm(), turn.norm() > 0 ? Eigen::Vector3d(turn.normalized())
                                                                             : Eigen::Vector3d::UnitX())
                                  .toRotationMatrix();
  }
  EXPECT_LT((T.translation() - way.pose(5.0).translation()).norm(), 1e-5);
  EXPECT_LT((T.linear() - way.pose(5.0).linear()).norm(), 1e-5);
}

}  // namespace
}  // namespace field_fusion::core::sim
