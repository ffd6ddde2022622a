#pragma once
// Where the search of core/calib/camera_imu.h begins: by turns alone, of the camera against the board and of
// the gyroscope.
#include "field_fusion/core/calib/camera_imu.h"

namespace field_fusion::core {

/// Where the camera saw the board from, in one order of the corners over the whole recording.
struct CameraPlace {
  double stamp = 0.0;  ///< [s] of the camera's clock
  std::vector<Eigen::Vector2d> corners;
  Transform T_board_camera;
};

/// A board may look the same from both ends: what fits the place before is taken. Sightings that fit no pose
/// are left out.
std::vector<CameraPlace> cameraPlaces(const Board& board, const CameraLens& lens,
                                      const std::vector<Sighting>& sightings);

struct CameraImuStart {
  double time_offset = 0.0;  ///< [s]
  Eigen::Matrix3d R_camera_imu;
  Eigen::Vector3d gyro_bias;  ///< [rad/s]
};

/// The offset and rotation by which the turns between pictures fit the gyroscope best. Throws
/// std::runtime_error with the reason where there is none: too few pictures or readings at one time, no
/// turning, turning about one axis, nothing that fits.
CameraImuStart startCameraImu(const std::vector<CameraPlace>& places, const std::vector<ImuReading>& readings,
                              const CameraImuOptions& options);

}  // namespace field_fusion::core
