#pragma once
// A camera and an inertial unit that are moved before a board, with noise of known size: what the solver must
// get right, for tests and for the share of runs in which its covariance holds. Without pictures; the
// simulator has those.
#include <random>

#include "field_fusion/core/calib/camera_imu.h"

namespace field_fusion::core {

struct MotionParams {
  double seconds = 12.0;
  double picture_rate = 20.0, reading_rate = 200.0;  ///< [Hz]
  double turn = radians(15.0);                       ///< [rad] amplitude about each axis
  Eigen::Vector3d turns{1, 1, 1};  ///< times `turn`, about the camera's x right, y down, z ahead
  double shift = 0.1;              ///< [m] amplitude along each axis
  double pixel_noise = 0.1;        ///< [px]
  double gyro_noise = 0.0025, accel_noise = 0.015;  ///< [rad/s], [m/s^2] of a reading
  double gyro_bias = 0.02, accel_bias = 0.5;        ///< drawn evenly up to it
  double gyro_walk = 3.5e-5, accel_walk = 2e-4;     ///< [rad/s/sqrt(s)], [m/s^2/sqrt(s)]
  double time_offset = 0.0;                         ///< [s] the unit's stamp less the camera's
};

struct DrawnMotion {
  Transform T_camera_imu;
  std::vector<Sighting> sightings;  ///< pictures that show the whole board
  std::vector<ImuReading> readings;
};

/// Turns and shifts are three oscillations each, of 0.3 to 1.5 Hz. The same engine state gives the same
/// motion.
DrawnMotion drawMotion(const Board& board, const CameraLens& lens, const MotionParams& params,
                       std::mt19937& random);

}  // namespace field_fusion::core
