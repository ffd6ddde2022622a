#include "field_fusion/core/sim/imu.h"

#include <cmath>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kMilli = kGravity * 1e-3, kMicro = kGravity * 1e-6;  // [m/s^2] of a mg, a ug

Eigen::Vector3d clipped(const Eigen::Vector3d& v, double most) { return v.cwiseMax(-most).cwiseMin(most); }

}  // namespace

ImuSample perfectImu(const Trajectory& way, const Transform& T_base_imu, double time, double span) {
  const double half = span / 2;
  const Transform before = way.pose(time - half) * T_base_imu, now = way.pose(time) * T_base_imu,
                  after = way.pose(time + half) * T_base_imu;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
  const Eigen::Vector3d acceleration =
      (before.translation() - 2 * now.translation() + after.translation()) / (half * half);
  ImuSample sample;
  sample.time = time;
  sample.angular_rate = turn.axis() * turn.angle() / span;
  sample.specific_force = now.linear().transpose() * (acceleration + Eigen::Vector3d(0, 0, kGravity));
  return sample;
}

Imu::Imu(const ImuParams& params, const Trajectory& way, const Transform& T_base_imu, std::uint64_t seed)
    : params_(checked(params)), way_(way), T_base_imu_(T_base_imu), random_(seed) {
  gyro_bias_ = draw(radians(params_.gyro_bias));
  accel_bias_ = draw(params_.accel_bias * kMilli);
}

Eigen::Vector3d Imu::draw(double sigma) {
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) out[i] = sigma * normal_(random_);
  return out;
}

ImuSample Imu::next() {
  const double period = 1 / params_.rate, bandwidth = std::sqrt(params_.rate / 2);
  ImuSample sample = perfectImu(way_, T_base_imu_, static_cast<double>(count_++) * period, period);
  sample.angular_rate =
      clipped(sample.angular_rate + gyro_bias_ + draw(radians(params_.gyro_noise) * bandwidth),
              radians(params_.gyro_range));
  sample.specific_force =
      clipped(sample.specific_force + accel_bias_ + draw(params_.accel_noise * kMicro * bandwidth),
              params_.accel_range * kGravity);
  const auto error = [&](double noise, double bias, double walk) {
    return Eigen::Vector3d(noise * bandwidth, bias, walk * std::sqrt(sample.time)).norm();
  };
  sample.sigma_rate = radians(error(params_.gyro_noise, params_.gyro_bias, params_.gyro_walk));
  sample.sigma_force = kMilli * error(1e-3 * params_.accel_noise, params_.accel_bias, params_.accel_walk);
  gyro_bias_ += draw(radians(params_.gyro_walk) * std::sqrt(period));
  accel_bias_ += draw(params_.accel_walk * kMilli * std::sqrt(period));
  return sample;
}

}  // namespace field_fusion::core::sim
