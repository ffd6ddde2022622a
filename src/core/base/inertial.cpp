#include "field_fusion/core/base/inertial.h"

#include <stdexcept>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core {
namespace {

constexpr double kSilence = 0.5;               // [s]
constexpr double kRestRate = radians(2.0);     // [rad/s] from least to most, noise of a cheap unit
constexpr double kRestForce = 0.5;             // [m/s^2] from least to most
constexpr double kLargestBias = radians(5.0);  // [rad/s] a steady turn is no bias

Eigen::Quaterniond turned(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

}  // namespace

void Inertial::setParams(const InertialParams& params) { params_ = checked(params); }

void Inertial::reset() {
  *this = Inertial(params_);
}

void Inertial::start(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force) {
  if (!pose_) {
    pose_.emplace();
    pose_->rotation = Eigen::Quaterniond::FromTwoVectors(force, Eigen::Vector3d::UnitZ());
    gravity_ = force.norm();
  }
  pose_->time = time;
  velocity_.setZero();
  last_rate_ = rate;
  rest_ = {};
}

TimedPose Inertial::add(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force) {
  if (!rate.allFinite() || !force.allFinite())
    throw std::runtime_error("imu damaged: a number is not finite");
  if (!pose_ || time - pose_->time > kSilence) {
    start(time, rate, force);
    return *pose_;
  }
  const double dt = time - pose_->time;
  if (!(dt > 0.0)) return *pose_;
  learnBias(time, rate, force);
  auto& rotation = pose_->rotation;
  const Eigen::Vector3d up = rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d righting =
      force.norm() > 0.0 ? force.normalized().cross(up).eval() : Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean_rate = 0.5 * (rate + last_rate_) - bias_ + righting / params_.gravity_time;
  rotation = (rotation * turned(dt * mean_rate)).normalized();
  gravity_ += std::min(1.0, dt / params_.gravity_time) * (force.norm() - gravity_);
  const Eigen::Vector3d acceleration = rotation * force - gravity_ * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d before = velocity_;
  velocity_ = std::exp(-dt / params_.velocity_time) * velocity_ + dt * acceleration;
  pose_->position += 0.5 * dt * (before + velocity_);
  pose_->time = time;
  last_rate_ = rate;
  return *pose_;
}

void Inertial::learnBias(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force) {
  if (rest_.samples == 0) rest_.begin = time;
  ++rest_.samples;
  rest_.sum += rate;
  rest_.rates.extend(rate);
  rest_.forces.extend(force);
  const bool still =
      (rest_.rates.sizes().array() < kRestRate).all() && (rest_.forces.sizes().array() < kRestForce).all();
  if (!still) {
    rest_ = {};
    return;
  }
  if (params_.still_time == 0.0 || time - rest_.begin < params_.still_time) return;
  const Eigen::Vector3d mean = rest_.sum / rest_.samples;
  if (mean.norm() < kLargestBias) bias_ = mean;
  rest_ = {};
}

}  // namespace field_fusion::core
