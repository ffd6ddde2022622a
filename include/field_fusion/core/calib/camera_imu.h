#pragma once
// Where an inertial unit stands to a camera, and by how much their clocks differ, from a recording in which
// both are moved before a checkerboard at rest: the motion as a spline that corners, rates and forces must
// all fit (Furgale, Rehder and Siegwart 2013, which Kalibr follows; paper 004, section 2.3, uses that).
#include <vector>

#include "field_fusion/core/calib/rest.h"

namespace field_fusion::core {

struct ImuReading {
  double stamp = 0.0;     ///< [s]
  Eigen::Vector3d rate;   ///< [rad/s] in the unit's frame
  Eigen::Vector3d force;  ///< [m/s^2] specific force, +g upwards at rest
};

struct CameraImuOptions {
  double max_offset = 0.5;  ///< [s] by which the clocks differ at most
  double gyro_walk =
      5e-5;  ///< [rad/s/sqrt(s)] random walk of the gyroscope's bias, as calibrate_imu tells it
  double accel_walk = 5e-4;  ///< [m/s^2/sqrt(s)] likewise of the accelerometer's
  double knots = 50.0;       ///< [1/s] of the spline at most; a quarter of the readings where that is less
};

struct CameraImuCalibration {
  Transform T_camera_imu;
  double time_offset = 0.0;  ///< [s] the unit's stamp less the camera's, of the same instant
  /// Of (x, t): T_true = T_camera_imu * motion(x), see chart.h: [rad] about and [m] along the unit's axes;
  /// true offset less time_offset [s].
  Eigen::Matrix<double, 7, 7> covariance;
  Eigen::Vector3d gravity;                ///< [m/s^2] in the board's frame
  Eigen::Vector3d gyro_bias, accel_bias;  ///< [rad/s], [m/s^2] mean over the recording
  double pixel_sigma = 0, gyro_sigma = 0,
         accel_sigma = 0;                ///< [px], [rad/s], [m/s^2] noise as measured, of one axis
  std::size_t frames = 0, readings = 0;  ///< that were used
  double reprojection = 0;               ///< [px] root mean square

  double rotationSigma() const;     ///< [rad] root of the summed variances
  double translationSigma() const;  ///< [m]
  double offsetSigma() const;       ///< [s]
};

/// Throws std::invalid_argument for readings that are not finite or not in the order of their stamps.
void checkReadings(const std::vector<ImuReading>& readings);

/// `sightings`: the corners of each picture that shows the whole board; `readings` of the unit; both in the
/// order of their stamps. Throws std::invalid_argument for what is not finite or not in order,
/// std::runtime_error with the reason for a recording that leaves something unknown: too short, a gap in the
/// readings, no turning, turning about one axis alone, clocks too far apart.
CameraImuCalibration calibrateCameraImu(const Board& board, const CameraLens& lens,
                                        const std::vector<Sighting>& sightings,
                                        const std::vector<ImuReading>& readings,
                                        const CameraImuOptions& options);

}  // namespace field_fusion::core
