#pragma once
// The least-squares problem of core/calib/camera_imu.h.
#include <ceres/ceres.h>

#include <Eigen/SparseCore>

#include "camera_imu_start.h"
#include "field_fusion/core/calib/chart.h"
#include "field_fusion/core/calib/pose_spline.h"

namespace field_fusion::core {

class CameraImuProblem {
 public:
  /// Readings between the first and the last picture count, and pictures between the first and the last
  /// reading.
  CameraImuProblem(const Board& board, const CameraLens& lens, std::vector<CameraPlace> places,
                   std::vector<ImuReading> readings, const CameraImuStart& start,
                   const CameraImuOptions& options);

  /// Minimises, then measures the noise from what is left and minimises again, until it settles.
  void solve();
  /// With the covariance. Throws std::runtime_error where the normal equations have no inverse.
  CameraImuCalibration result();

 private:
  using Six = std::array<double, 6>;
  /// Residual blocks of one kind; `sigma`: of their noise.
  struct Kind {
    double sigma;
    std::vector<ceres::ResidualBlockId> blocks;
  };
  /// Of all residuals at where the search stands.
  struct Linear {
    std::vector<double> residuals;
    Eigen::SparseMatrix<double> jacobian;            // columns: points, biases, tilt, x, t
    Eigen::Index pictures = 0, gyro = 0, accel = 0;  // rows, in this order; then those of the biases
  };

  void placePoints(const std::vector<CameraPlace>& places);
  void findUp(const std::vector<CameraPlace>& places);
  void build(ceres::Problem& problem);
  void addPictures(ceres::Problem& problem);
  void addReadings(ceres::Problem& problem);
  void minimise(double tolerance);
  Linear linearised();
  void measureNoise();

  const CameraLens& lens_;
  const CameraImuOptions options_;
  const std::vector<Eigen::Vector3d> corners_;
  std::vector<CameraPlace> places_;
  std::vector<ImuReading> readings_;
  SplineGrid grid_, bias_grid_;
  Eigen::Matrix3d R_board_reference_;  // turns of the spline count from here
  std::vector<Six> points_;            // turn, place of the unit in the board's frame
  std::vector<Six> biases_;            // gyroscope, accelerometer
  Eigen::Quaterniond R_board_up_;      // carries z to upwards
  std::array<double, 2> tilt_{};
  Transform T_camera_imu_;
  Chart x_{};
  double time_offset_, t_ = 0.0;
  Kind pictures_{0.2, {}}, gyro_{0.01, {}}, accel_{0.1, {}};
  std::vector<ceres::ResidualBlockId> walks_;
};

}  // namespace field_fusion::core
