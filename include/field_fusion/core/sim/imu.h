#pragma once
// An inertial measurement unit on a moving body.
#include <cstdint>
#include <random>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

/// Noise densities are one-sided, as data sheets give them: the standard deviation of a sample is the density
/// times sqrt(rate / 2). Defaults: config/sensors/bmi055.yaml.
struct ImuParams {
  double rate = 200.0;
  double gyro_noise = 0.014;
  double gyro_bias = 1.0;
  double gyro_walk = 0.002;
  double gyro_range = 2000.0;
  double accel_noise = 150.0;
  double accel_bias = 70.0;
  double accel_walk = 0.02;
  double accel_range = 16.0;

  void declare(Params& p) {
    p.number("rate", rate, {1.0, 10000.0}, "Hz", When::kStart, "Samples a second.");
    p.number("gyro_noise", gyro_noise, {0.0, 10.0}, "deg/s/sqrt(Hz)", When::kStart, "Noise of each axis.");
    p.number("gyro_bias", gyro_bias, {0.0, 50.0}, "deg/s", When::kStart,
             "Standard deviation of the bias, drawn per seed.");
    p.number("gyro_walk", gyro_walk, {0.0, 1.0}, "deg/s/sqrt(s)", When::kStart, "Random walk of the bias.");
    p.number("gyro_range", gyro_range, {1.0, 100000.0}, "deg/s", When::kStart, "Largest rate it can tell.");
    p.number("accel_noise", accel_noise, {0.0, 100000.0}, "ug/sqrt(Hz)", When::kStart, "Noise of each axis.");
    p.number("accel_bias", accel_bias, {0.0, 1000.0}, "mg", When::kStart,
             "Standard deviation of the bias, drawn per seed.");
    p.number("accel_walk", accel_walk, {0.0, 100.0}, "mg/sqrt(s)", When::kStart, "Random walk of the bias.");
    p.number("accel_range", accel_range, {0.1, 1000.0}, "g", When::kStart, "Largest force it can tell.");
  }
};

struct ImuSample {
  double time = 0.0;                      ///< [s]
  Eigen::Vector3d angular_rate{0, 0, 0};  ///< [rad/s] in the sensor's frame
  Eigen::Vector3d specific_force{0, 0,
                                 0};  ///< [m/s^2] in the sensor's frame; +g upwards when it stands still
  double sigma_rate = 0.0;            ///< [rad/s] error to expect of each axis: noise, bias and its walk
  double sigma_force = 0.0;           ///< [m/s^2]
};

/// What a perfect unit at `T_base_imu` feels, as the mean over `span` [s] about `time`: lever arm and shake
/// are in it, because it follows from the sensor's own way.
ImuSample perfectImu(const Trajectory& way, const Transform& T_base_imu, double time, double span);

class Imu {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  Imu(const ImuParams& params, const Trajectory& way, const Transform& T_base_imu, std::uint64_t seed);
  ImuSample next();  ///< the samples at 0, 1/rate, 2/rate ... [s]

 private:
  Eigen::Vector3d draw(double sigma);

  ImuParams params_;
  Trajectory way_;
  Transform T_base_imu_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d gyro_bias_, accel_bias_;
  std::uint64_t count_ = 0;
};

}  // namespace field_fusion::core::sim
