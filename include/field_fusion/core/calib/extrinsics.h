#pragma once
// Where a LiDAR or 2-D scanner stands to a camera, from poses of a checkerboard that both see (paper 004, section 2.3 and
// Fig. 3). The paper solves for the board in each sensor and multiplies; here all poses of the board, the transform and
// what is wrong with the ranges are found at once, so that the covariance knows of all noise.
#include <map>
#include <string>
#include <vector>

#include "field_fusion/core/calib/board.h"

namespace field_fusion::core {

/// The mean of `count` returns from about the same place of the board.
struct BoardReturn {
  Eigen::Vector3d position;  ///< [m] in the LiDAR's frame
  int laser = 0;             ///< row of the sensor; each has a range offset of its own
  int count = 1;
};

struct CalibrationPose {
  std::string name;
  BoardView view;
  std::vector<BoardReturn> returns;
};

struct CalibrationOptions {
  double pixel_sigma = 0.1;   ///< [px] noise of a corner: where the search starts, then it is measured
  double range_sigma = 0.01;  ///< [m] noise of a single return, likewise
  double offset_sigma = 0.0;  ///< [m] what range offset of a laser to expect; 0: there is none
  double scale_sigma = 0.0;   ///< what scale error of the ranges to expect, such as 0.002; 0: there is none
};

struct PoseResidual {
  std::string name;
  bool used = true;           ///< false: an outlier, left out
  std::size_t returns = 0;    ///< single ones
  double mean = 0, rms = 0;   ///< [m] of the returns' distances to the board, positive behind it
  double reprojection = 0;    ///< [px] root mean square
};

struct Calibration {
  Transform T_camera_lidar;
  /// Of x with T_true = T_camera_lidar * motion(x), see chart.h: [rad] about and [m] along the LiDAR's axes.
  Eigen::Matrix<double, 6, 6> covariance;
  std::map<int, double> offsets;  ///< [m] of each laser: measured less true
  double scale = 0.0;             ///< measured range over the true one, less 1
  double pixel_sigma = 0, range_sigma = 0;  ///< as measured; the second is the median of the poses'
  std::vector<PoseResidual> poses;

  double rotationSigma() const;     ///< [rad] root of the summed variances
  double translationSigma() const;  ///< [m]
};

/// `T_camera_lidar` is where to start. Throws std::invalid_argument for what is not finite, std::runtime_error with the
/// reason for poses that leave a direction unknown: fewer than three, boards all parallel, lines of one plane.
Calibration calibrate(const Board& board, const CameraLens& lens, std::vector<CalibrationPose> poses,
                      const Transform& T_camera_lidar, const CalibrationOptions& options);

/// The same without a start: from several, the one that fits best.
Calibration calibrateFromAnywhere(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
                                  const CalibrationOptions& options);

/// By what factor the ranges are longer than the board's stated size has them, by the poses that were used: a scale
/// that no scanner has is a wrong size, of squares that are `factor` times as large.
struct RangeFactor {
  double factor = 1.0, sigma = 0.0;
};
RangeFactor rangeFactor(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
                        const Calibration& found, const CalibrationOptions& options);

/// Why these poses leave something unknown, by the geometry alone; empty: they do not. `T_camera_lidar` as found.
std::string degenerate(const std::vector<CalibrationPose>& poses, const Transform& T_camera_lidar);

}  // namespace field_fusion::core
