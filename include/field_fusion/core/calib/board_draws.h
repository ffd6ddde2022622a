#pragma once
// Boards before an ideal camera and LiDAR with noise of known size: what the solver must get right, for tests and for
// the share of runs in which its covariance holds. Without pictures and rays; the simulator has those.
#include <random>

#include "field_fusion/core/calib/extrinsics.h"

namespace field_fusion::core {

struct DrawParams {
  int poses = 30;
  bool flat = false;          ///< a 2-D scanner in place of 16 rows, 2 degrees apart
  double pixel_noise = 0.1;   ///< [px]
  double range_noise = 0.01;  ///< [m] of a single return
  double range_bias = 0.0;    ///< [m] each laser's offset is drawn evenly up to it
  double range_scale = 0.0;   ///< likewise of the scale
  double tilt = radians(40.0);  ///< [rad] boards are turned up to it about each axis
};

struct DrawnBoards {
  Transform T_camera_lidar;
  double scale = 0.0;
  std::vector<CalibrationPose> poses;
};

/// The board within sight of both sensors, 1.2 to 3 m away. The same engine state gives the same boards.
DrawnBoards drawBoards(const Board& board, const CameraLens& lens, const DrawParams& params, std::mt19937& random);

/// A lens of 720 x 540 pixels with the distortion of a usual wide one.
CameraLens usualLens();

}  // namespace field_fusion::core
