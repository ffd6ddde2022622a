#include "field_fusion/core/sim/imu.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace field_fusion::core::sim {
namespace {

ImuParams perfect() {
  ImuParams params;
  params.gyro_noise = params.gyro_bias = params.gyro_walk = 0.0;
  params.accel_noise = params.accel_bias = params.accel_walk = 0.0;
  return params;
}

std::vector<ImuSample> samples(Imu imu, int count) {
  std::vector<ImuSample> out;
  for (int i = 0; i < count; ++i) out.push_back(imu.next());
  return out;
}

Transform rolled(double angle) { return Transform(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX())); }

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (double v : values) sum += v, squares += v * v;
  const double n = static_cast<double>(values.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

TEST(SimImu, StandingStillItFeelsGravityAlone) {
  const auto all = samples(Imu(perfect(), Trajectory(), rolled(radians(90)), 1), 3);
  EXPECT_NEAR(all[2].time, 0.01, 1e-12);
  EXPECT_TRUE(all[2].specific_force.isApprox(Eigen::Vector3d(0, kGravity, 0), 1e-9));  // its y is up
  EXPECT_LT(all[2].angular_rate.norm(), 1e-12);
}

TEST(SimImu, FeelsTheAccelerationOfTheWay) {
  Trajectory::Limits limits;
  limits.speed = 4.0;
  limits.acceleration = 2.0;
  const Trajectory way({{{0, 0, 0}, kNaN, 0.0}, {{0, 100, 0}, kNaN, 0.0}}, limits);
  const ImuSample rising = perfectImu(way, Transform::Identity(), 1.0, 0.005);
  EXPECT_TRUE(rising.specific_force.isApprox(Eigen::Vector3d(2, 0, kGravity), 1e-6));
  const ImuSample steady = perfectImu(way, Transform::Identity(), 10.0, 0.005);
  EXPECT_TRUE(steady.specific_force.isApprox(Eigen::Vector3d(0, 0, kGravity), 1e-6));
}

TEST(SimImu, LeverArmFeelsTheCentripetalForce) {
  Trajectory::Limits limits;
  limits.turn_rate = radians(90);
  const Trajectory way({{{0, 0, 0}, 0.0, 0.0}, {{0, 0, 0}, radians(170), 0.0}}, limits);
  const Transform T_base_imu(Eigen::Translation3d(0.5, 0, 0));
  const ImuSample sample = perfectImu(way, T_base_imu, 1.0, 0.005);  // in the steady part
  EXPECT_NEAR(sample.angular_rate.z(), radians(90), 1e-9);
  EXPECT_NEAR(sample.specific_force.x(), -0.5 * std::pow(radians(90), 2), 1e-4);
  EXPECT_NEAR(sample.specific_force.z(), kGravity, 1e-6);
}

TEST(SimImu, NoiseIsItsDensityOverTheBand) {
  ImuParams params = perfect();
  params.gyro_noise = 0.02;
  params.accel_noise = 200.0;
  std::vector<double> gyro, accel;
  for (const ImuSample& s : samples(Imu(params, Trajectory(), Transform::Identity(), 5), 20000)) {
    gyro.push_back(s.angular_rate.y());
    accel.push_back(s.specific_force.z());
  }
  EXPECT_NEAR(deviation(gyro), radians(0.02) * 10, radians(0.02) * 10 * 0.02);  // sqrt(200 Hz / 2) = 10
  EXPECT_NEAR(deviation(accel), 200e-6 * kGravity * 10, 200e-6 * kGravity * 10 * 0.02);
}

TEST(SimImu, BiasIsDrawnPerSeedAndWalks) {
  ImuParams params = perfect();
  params.gyro_bias = 0.5;
  params.accel_walk = 1.0;
  std::vector<double> bias, walked;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto all = samples(Imu(params, Trajectory(), Transform::Identity(), seed), 801);  // 4 s
    bias.push_back(all.front().angular_rate.x());
    walked.push_back(all.back().specific_force.x());
    EXPECT_NEAR(all.back().angular_rate.x(), bias.back(), 1e-12);
  }
  EXPECT_NEAR(deviation(bias), radians(0.5), radians(0.5) * 0.1);
  EXPECT_NEAR(deviation(walked), 1e-3 * kGravity * 2, 1e-3 * kGravity * 2 * 0.1);  // sqrt(4 s) = 2
}

TEST(SimImu, IsItsSeeds) {
  const auto a = samples(Imu({}, Trajectory(), rolled(0.1), 7), 50);
  const auto b = samples(Imu({}, Trajectory(), rolled(0.1), 7), 50);
  const auto c = samples(Imu({}, Trajectory(), rolled(0.1), 8), 50);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(a[i].angular_rate, b[i].angular_rate);
    EXPECT_EQ(a[i].specific_force, b[i].specific_force);
    EXPECT_NE(a[i].angular_rate, c[i].angular_rate);
  }
}

/// At rest, over seeds: noise, bias and its walk add up as independent errors do.
TEST(SimImu, TellsTheErrorToExpect) {
  constexpr int kSeeds = 500, kSample = 400;  // at 2 s
  const ImuParams params;
  double rate = 0.0, force = 0.0;
  ImuSample sample;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Imu imu(params, Trajectory(), rolled(0), static_cast<std::uint64_t>(seed));
    for (int i = 0; i <= kSample; ++i) sample = imu.next();
    rate += sample.angular_rate.squaredNorm() / (3 * kSeeds);
    force += (sample.specific_force - Eigen::Vector3d(0, 0, kGravity)).squaredNorm() / (3 * kSeeds);
  }
  // noise of 0.014 deg/s/sqrt(Hz) over 100 Hz, bias of 1 deg/s, walk of 0.002 deg/s/sqrt(s) over 2 s
  EXPECT_NEAR(sample.sigma_rate, radians(std::sqrt(0.14 * 0.14 + 1.0 + 0.002 * 0.002 * 2)), 1e-9);
  // 150 ug/sqrt(Hz): 1.5 mg; bias of 70 mg, walk of 0.02 mg/sqrt(s)
  EXPECT_NEAR(sample.sigma_force, 1e-3 * kGravity * std::sqrt(1.5 * 1.5 + 70.0 * 70.0 + 0.02 * 0.02 * 2), 1e-9);
  const double slack = 4 * std::sqrt(2.0 / (3 * kSeeds));  // four deviations of a variance's estimate
  EXPECT_NEAR(rate / std::pow(sample.sigma_rate, 2), 1.0, slack);
  EXPECT_NEAR(force / std::pow(sample.sigma_force, 2), 1.0, slack);
}

TEST(SimImu, SaysNoMoreThanItsRange) {
  ImuParams params = perfect();
  params.accel_range = 0.5;
  EXPECT_EQ(Imu(params, Trajectory(), rolled(0), 1).next().specific_force.z(), 0.5 * kGravity);
}

TEST(SimImu, RefusesARateOfZero) {
  ImuParams params;
  params.rate = 0.0;
  EXPECT_THROW(Imu(params, Trajectory(), rolled(0), 1), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
