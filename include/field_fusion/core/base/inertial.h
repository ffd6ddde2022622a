#pragma once
// Dead reckoning by an inertial unit alone: `method: imu` of the deskew stages, the rival that paper 004
// takes from its reference [18].
#include <optional>

#include "field_fusion/core/base/pose_history.h"

namespace field_fusion::core {

struct InertialParams {
  double gravity_time = 2.0;
  double velocity_time = 0.5;
  double still_time = 0.5;

  void declare(Params& p) {
    p.number("imu_gravity_time", gravity_time, {0.1, 1000.0}, "s", When::kLive,
             "imu: how slowly the accelerometer rights the attitude of the gyroscope.");
    p.number(
        "imu_velocity_time", velocity_time, {0.001, 1000.0}, "s", When::kLive,
        "imu: how long the integrated acceleration counts as velocity. Longer sees more of the motion and "
        "gathers more of the bias.");
    p.number("imu_still_time", still_time, {0.0, 60.0}, "s", When::kLive,
             "imu: after so long without motion the mean rate is the gyroscope's bias; 0: never.");
  }
};

/// Rotation by the gyroscope, righted slowly by the accelerometer; place by integrating the acceleration
/// twice. The velocity fades: neither its start nor the accelerometer's bias is known.
class Inertial {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit Inertial(const InertialParams& params = {}) { setParams(params); }
  void setParams(const InertialParams& params);

  /// The unit's pose since its first sample, level at first. Rate [rad/s] and specific force [m/s^2] in the
  /// unit's frame. Throws std::runtime_error "imu damaged: ..." where a number is not finite. Times rise;
  /// after more than 0.5 s of silence it starts anew, where it was.
  TimedPose add(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force);
  void reset();
  const Eigen::Vector3d& bias() const { return bias_; }  ///< [rad/s] of the gyroscope

 private:
  void start(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force);
  void learnBias(double time, const Eigen::Vector3d& rate, const Eigen::Vector3d& force);

  InertialParams params_;
  std::optional<TimedPose> pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_rate_ = Eigen::Vector3d::Zero();
  double gravity_ = 0.0;  // [m/s^2] as the accelerometer tells it
  struct Rest {
    double begin = 0.0;
    int samples = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::AlignedBox3d rates, forces;
  } rest_;
};

}  // namespace field_fusion::core
