#include "field_fusion/core/sim/odometry.h"

#include <algorithm>
#include <cmath>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kStride = 0.5;  // [s]

double yawOf(const Transform& pose) { return std::atan2(pose(1, 0), pose(0, 0)); }

Eigen::Matrix3d turned(double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Transform placed(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation) {
  Transform out = Transform::Identity();
  out.linear() = rotation;
  out.translation() = position;
  return out;
}

StrideError::Noise noiseOf(const WheelOdometryParams& p) {
  return {p.distance_noise, radians(p.yaw_noise), 0.0, 0.0, 0.0};
}

StrideError::Noise noiseOf(const LegOdometryParams& p) {
  return {p.distance_noise, radians(p.yaw_noise), p.slip_rate, p.slip, radians(p.slip_yaw)};
}

}  // namespace

StrideError::StrideError(const Noise& noise, double rate, std::uint64_t seed)
    : noise_(noise), samples_(std::max(1, static_cast<int>(std::lround(kStride * rate)))), random_(seed) {}

void StrideError::beginStride(const Eigen::Vector3d& position) {
  stride_length_ = (position - begin_).norm();
  distance_ += stride_length_;
  begin_ = position;
  const double root = std::sqrt(stride_length_);
  for (int i = 0; i < 4; ++i) error_[i] = (i < 3 ? noise_.distance : noise_.yaw) * root * draw();
  std::poisson_distribution<int> slips(noise_.slip_rate * stride_length_);
  for (int i = noise_.slip_rate * stride_length_ > 0 ? slips(random_) : 0; i > 0; --i)
    error_ += Eigen::Vector4d(noise_.slip * draw(), noise_.slip * draw(), 0.0, noise_.slip_yaw * draw());
  error_ /= samples_;
}

Eigen::Vector4d StrideError::step(const Eigen::Vector3d& position) {
  if (!started_) begin_ = position;
  started_ = true;
  if (at_++ % samples_ == 0) beginStride(position);
  return error_;
}

Eigen::Vector3d StrideError::sigmaRate(double rate) const {
  const double root = std::sqrt(stride_length_), slips = std::sqrt(noise_.slip_rate) * root;
  return Eigen::Vector3d(std::hypot(noise_.distance * root, noise_.slip * slips), noise_.distance * root,
                         std::hypot(noise_.yaw * root, noise_.slip_yaw * slips)) *
         (rate / samples_);
}

WheelOdometry::WheelOdometry(const WheelOdometryParams& params, const Trajectory& way, std::uint64_t seed)
    : params_(checked(params)), way_(way), error_(noiseOf(params_), params_.rate, seed) {
  scale_ = 1 + params_.scale_error / 100 * error_.draw();
  turn_scale_ = 1 + params_.turn_error / 100 * error_.draw();
  drift_ = radians(params_.yaw_drift) * error_.draw();
  last_ = way_.pose(0).translation();
  last_yaw_ = yawOf(way_.pose(0));
}

OdometrySample WheelOdometry::next() {
  const double time = static_cast<double>(count_++) / params_.rate;
  const Transform pose = way_.pose(time);
  const double turn = angleDifference(yawOf(pose), last_yaw_), middle = last_yaw_ + turn / 2;
  const Eigen::Vector3d ahead(std::cos(middle), std::sin(middle), 0.0);
  const double forward = ahead.dot(pose.translation() - last_);
  const Eigen::Vector4d error = count_ == 1 ? Eigen::Vector4d::Zero() : error_.step(pose.translation());

  const double told = scale_ * forward + error[0];
  const double told_turn = turn_scale_ * turn + drift_ * std::abs(forward) + error[3];
  position_ += turned(yaw_ + told_turn / 2) * Eigen::Vector3d(told, 0, 0);
  yaw_ += told_turn;
  last_ = pose.translation();
  last_yaw_ = yawOf(pose);

  OdometrySample sample;
  sample.time = time;
  sample.T_odom_base = placed(position_, turned(yaw_));
  sample.velocity = {told * params_.rate, 0, 0};
  sample.angular_rate = {0, 0, told_turn * params_.rate};
  const double d = error_.distance();
  sample.sigma_position = std::hypot(params_.scale_error / 100 * d, params_.distance_noise * std::sqrt(d));
  sample.sigma_yaw = radians(std::hypot(params_.yaw_drift * d, params_.yaw_noise * std::sqrt(d)));
  const Eigen::Vector3d by_stride = error_.sigmaRate(params_.rate);
  const double speed = std::abs(sample.velocity.x());
  sample.sigma_velocity.x() = std::hypot(params_.scale_error / 100 * speed, by_stride[0]);
  sample.sigma_angular_rate.z() =
      Eigen::Vector3d(params_.turn_error / 100 * sample.angular_rate.z(), radians(params_.yaw_drift) * speed,
                      by_stride[2])
          .norm();
  return sample;
}

LegOdometry::LegOdometry(const LegOdometryParams& params, const Trajectory& way, std::uint64_t seed)
    : params_(checked(params)), way_(way), error_(noiseOf(params_), params_.rate, seed), last_(way.pose(0)) {
  scale_ = params_.scale_error / 100 * error_.draw();
  drift_ = radians(params_.yaw_drift) * error_.draw();
  for (int i = 0; i < 3; ++i) phase_[i] = radians(180.0) * error_.draw();
  T_odom_world_ = placed(last_.translation(), turned(yawOf(last_))).inverse();
  last_ = T_odom_world_ * last_;
  position_ = last_.translation();
}

Eigen::Vector3d LegOdometry::vibration(double time) {
  const double walking = std::min(1.0, error_.stride() / (0.1 * kStride));  // in full from 0.1 m/s
  const double angle = 2 * radians(180.0) * params_.vibration_frequency * time;
  return params_.vibration * 1e-3 * walking * (phase_.array() + angle).sin();
}

OdometrySample LegOdometry::next() {
  const double time = static_cast<double>(count_++) / params_.rate;
  const Transform pose = T_odom_world_ * way_.pose(time);
  const Eigen::Vector4d error = count_ == 1 ? Eigen::Vector4d::Zero() : error_.step(pose.translation());
  const Eigen::Vector3d moved = last_.linear().transpose() * (pose.translation() - last_.translation());
  const Eigen::Vector3d told = (1 + scale_) * moved + error.head<3>();
  const double drift = drift_ * moved.x() + error[3];
  position_ += turned(yaw_error_) * (last_.linear() * told);
  yaw_error_ += drift;

  OdometrySample sample;
  sample.time = time;
  sample.T_odom_base = placed(position_ + vibration(time), turned(yaw_error_) * pose.linear());
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(last_.linear().transpose() * pose.linear()));
  sample.velocity = told * params_.rate;
  sample.angular_rate =
      (turn.axis() * turn.angle() + pose.linear().transpose().col(2) * drift) * params_.rate;
  const double d = error_.distance(), slips = params_.slip_rate * d;
  sample.sigma_position =
      Eigen::Vector3d(params_.scale_error / 100 * d, params_.distance_noise * std::sqrt(d),
                      params_.slip * std::sqrt(slips))
          .norm();
  sample.sigma_yaw = radians(Eigen::Vector3d(params_.yaw_drift * d, params_.yaw_noise * std::sqrt(d),
                                             params_.slip_yaw * std::sqrt(slips))
                                 .norm());
  const double scale = params_.scale_error / 100;
  sample.sigma_height = std::hypot(scale * position_.z(), params_.distance_noise * std::sqrt(d));
  sample.sigma_tilt = 0.0;
  const Eigen::Vector3d by_stride = error_.sigmaRate(params_.rate);
  const Eigen::Array3d of_noise(by_stride[0], by_stride[0], by_stride[1]);
  sample.sigma_velocity = ((scale * sample.velocity).array().square() + of_noise.square()).sqrt();
  sample.sigma_angular_rate = {
      0.0, 0.0, std::hypot(radians(params_.yaw_drift) * sample.velocity.x(), by_stride[2])};
  last_ = pose;
  return sample;
}

}  // namespace field_fusion::core::sim
