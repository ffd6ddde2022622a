#pragma once
// Odometry of wheels and of legs: the body's own account of its way, with the errors that grow along it.
#include <cstdint>
#include <random>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/sim/trajectory.h"

namespace field_fusion::core::sim {

/// Defaults: config/sensors/wheel_odometry.yaml.
struct WheelOdometryParams {
  double rate = 50.0;
  double scale_error = 1.0;
  double turn_error = 2.0;
  double yaw_drift = 0.1;
  double distance_noise = 0.005;
  double yaw_noise = 0.2;

  void declare(Params& p) {
    p.number("rate", rate, {1.0, 10000.0}, "Hz", When::kStart, "Samples a second.");
    p.number("scale_error", scale_error, {0.0, 50.0}, "%", When::kStart,
             "Error of the wheels' size: standard deviation, drawn per seed.");
    p.number("turn_error", turn_error, {0.0, 50.0}, "%", When::kStart,
             "Error of the wheel base, a share of each turn: standard deviation, drawn per seed.");
    p.number("yaw_drift", yaw_drift, {0.0, 50.0}, "deg/m", When::kStart,
             "Unequal wheels turn it so much: standard deviation, drawn per seed.");
    p.number("distance_noise", distance_noise, {0.0, 1.0}, "m/sqrt(m)", When::kStart,
             "Random error of the distance.");
    p.number("yaw_noise", yaw_noise, {0.0, 90.0}, "deg/sqrt(m)", When::kStart, "Random error of the yaw.");
  }
};

/// Defaults: config/sensors/leg_odometry.yaml.
struct LegOdometryParams {
  double rate = 500.0;
  double scale_error = 1.0;
  double yaw_drift = 0.05;
  double distance_noise = 0.01;
  double yaw_noise = 0.1;
  double slip_rate = 0.05;
  double slip = 0.03;
  double slip_yaw = 0.5;
  double vibration = 1.0;
  double vibration_frequency = 8.0;

  void declare(Params& p) {
    p.number("rate", rate, {1.0, 10000.0}, "Hz", When::kStart, "Samples a second.");
    p.number("scale_error", scale_error, {0.0, 50.0}, "%", When::kStart,
             "Error of the legs' lengths: standard deviation, drawn per seed.");
    p.number("yaw_drift", yaw_drift, {0.0, 50.0}, "deg/m", When::kStart,
             "Constant turn along the way: standard deviation, drawn per seed.");
    p.number("distance_noise", distance_noise, {0.0, 1.0}, "m/sqrt(m)", When::kStart,
             "Random error of each axis.");
    p.number("yaw_noise", yaw_noise, {0.0, 90.0}, "deg/sqrt(m)", When::kStart, "Random error of the yaw.");
    p.number("slip_rate", slip_rate, {0.0, 10.0}, "1/m", When::kStart, "Slips of a foot.");
    p.number("slip", slip, {0.0, 1.0}, "m", When::kStart,
             "Error along and across of a slip: standard deviation.");
    p.number("slip_yaw", slip_yaw, {0.0, 90.0}, "deg", When::kStart,
             "Error of the yaw of a slip: standard deviation.");
    p.number("vibration", vibration, {0.0, 100.0}, "mm", When::kStart,
             "Amplitude by which impacts of the feet shake the answer while it walks.");
    p.number("vibration_frequency", vibration_frequency, {0.1, 100.0}, "Hz", When::kStart, "Of these.");
  }
};

/// Frame odom: where the body stood at time 0, level.
struct OdometrySample {
  double time = 0.0;                              ///< [s]
  Transform T_odom_base = Transform::Identity();  ///< wheels: level, at height 0
  Eigen::Vector3d velocity{0, 0, 0};              ///< [m/s] in the base's frame
  Eigen::Vector3d angular_rate{0, 0, 0};          ///< [rad/s] in the base's frame
  double sigma_position = 0.0;  ///< [m] error to expect of x and y, by the parameters and the distance
  double sigma_yaw = 0.0;       ///< [rad]
  // Errors to expect of the rest; NaN where it is not measured.
  double sigma_height = kNaN, sigma_tilt = kNaN;                          ///< [m], [rad] of roll and pitch
  Eigen::Vector3d sigma_velocity = Eigen::Vector3d::Constant(kNaN);      ///< [m/s]
  Eigen::Vector3d sigma_angular_rate = Eigen::Vector3d::Constant(kNaN);  ///< [rad/s]
};

/// The error that grows with the distance walked. It is drawn for each stride of 0.5 s, from the way made in
/// the stride before, so that shaking about the way is no distance, and is spread over the stride.
class StrideError {
 public:
  struct Noise {
    double distance, yaw;              ///< [m/sqrt(m)], [rad/sqrt(m)]
    double slip_rate, slip, slip_yaw;  ///< [1/m], [m], [rad]
  };
  StrideError(const Noise& noise, double rate, std::uint64_t seed);

  /// Errors of x, y, z [m] and yaw [rad] of one sample's step to `position`, along the body's axes.
  Eigen::Vector4d step(const Eigen::Vector3d& position);
  double draw() { return normal_(random_); }        ///< standard normal
  double distance() const { return distance_; }     ///< [m] up to the last stride
  double stride() const { return stride_length_; }  ///< [m] of the last stride
  /// Deviation of the errors' rates along x or y, z [m/s] and yaw [rad/s], by the last stride's length.
  Eigen::Vector3d sigmaRate(double rate) const;

 private:
  void beginStride(const Eigen::Vector3d& position);

  Noise noise_;
  int samples_;  // of a stride
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  int at_ = 0;
  bool started_ = false;
  Eigen::Vector3d begin_ = Eigen::Vector3d::Zero();
  Eigen::Vector4d error_ = Eigen::Vector4d::Zero();  // of each sample of this stride
  double distance_ = 0.0, stride_length_ = 0.0;
};

/// Wheels that do not slide sideways: they see the way ahead and the turns, not height, roll or pitch.
class WheelOdometry {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  WheelOdometry(const WheelOdometryParams& params, const Trajectory& way, std::uint64_t seed);
  OdometrySample next();  ///< the samples at 0, 1/rate, 2/rate ... [s]

 private:
  WheelOdometryParams params_;
  Trajectory way_;
  StrideError error_;
  double scale_, turn_scale_, drift_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), last_;
  double yaw_ = 0.0, last_yaw_;
  std::uint64_t count_ = 0;
};

/// Legs with the joint angles and an inertial unit fused: six degrees of freedom; roll and pitch do not drift
/// because gravity shows them.
class LegOdometry {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  LegOdometry(const LegOdometryParams& params, const Trajectory& way, std::uint64_t seed);
  OdometrySample next();  ///< the samples at 0, 1/rate, 2/rate ... [s]

 private:
  Eigen::Vector3d vibration(double time);

  LegOdometryParams params_;
  Trajectory way_;
  StrideError error_;
  double scale_, drift_;
  Eigen::Vector3d phase_;
  Transform T_odom_world_, last_;
  Eigen::Vector3d position_;
  double yaw_error_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace field_fusion::core::sim
