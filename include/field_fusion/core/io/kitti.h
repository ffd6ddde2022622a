#pragma once
// Recordings in the layout of the KITTI benchmarks (Geiger et al. 2012, 2013): clouds of a Velodyne
// HDL-64E and rectified images of the left colour camera.
#include <filesystem>
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/bearing.h"

namespace field_fusion::core {

/// The files of one instant.
struct KittiFrame {
  std::filesystem::path cloud;
  std::filesystem::path image;  ///< empty where the recording has no images
  std::filesystem::path calibration;
};

struct KittiCalibration {
  Pinhole camera;                                    ///< the left colour camera, rectified
  Transform T_camera_lidar = Transform::Identity();  ///< camera: optical frame of that camera
};

/// Frames in the order of their file names. Clouds are `velodyne/NAME.bin`, images `image_02/NAME.png` or
/// `image_2/NAME.png`, calibration `calib.txt` or `calib/NAME.txt`. Throws std::runtime_error where the
/// folder or its clouds are missing, or where clouds, images and calibrations do not belong together.
std::vector<KittiFrame> listKitti(const std::filesystem::path& folder);

/// Points as stored, with the row and time of hdl64.h; `turn` [s] is how long the scanner takes for one.
/// Throws std::runtime_error naming a file that cannot be read or whose size is not a number of points.
Cloud readKittiCloud(const std::filesystem::path& file, double turn = 0.1);

/// Reads `P2`, `R0_rect` (or `R_rect`) and `Tr_velo_to_cam` (or `Tr_velo_cam`), with or without colons:
/// T_camera_lidar = T_camera_reference * R0_rect * Tr_velo_to_cam, where P2 = K [I | t] places the colour
/// camera at t = K^-1 * (fourth column of P2) in the frame of the rectified reference camera.
/// Throws std::runtime_error naming file and key where one is missing or is not what it should be.
KittiCalibration readKittiCalibration(const std::filesystem::path& file);

}  // namespace field_fusion::core
