#pragma once
// The least-squares problem of core/calib/extrinsics.h.
#include <ceres/ceres.h>

#include "field_fusion/core/calib/chart.h"
#include "field_fusion/core/calib/extrinsics.h"

namespace field_fusion::core {

/// One pose of the board in the problem. The sigmas are of its own returns, for noise grows with slant and range.
struct PoseBlock {
  const CalibrationPose* pose;
  Transform T_camera_board;
  Chart x{};
  double range_sigma;
};

class JointProblem {
 public:
  JointProblem(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
               const Transform& T_camera_lidar, const CalibrationOptions& options);

  /// Minimises, then measures the noise from what is left and minimises again, until it settles.
  void solve();
  /// From far: without errors of the ranges, the boards held where the camera sees them; returns the cost.
  double solveCoarsely();

  /// Of the transform, and false where the normal equations have no inverse.
  bool covariance(Eigen::Matrix<double, 6, 6>& out);
  double scaleSigma();  ///< infinite where the normal equations have no inverse
  void removePose(std::size_t i) { blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(i)); }

  const std::vector<PoseBlock>& blocks() const { return blocks_; }
  PoseResidual residual(const CalibrationPose& pose, const Transform& T_camera_board) const;
  const Transform& T_camera_lidar() const { return T_camera_lidar_; }
  const std::map<int, double>& offsets() const { return offsets_; }
  double scale() const { return scale_; }
  double pixelSigma() const { return pixel_sigma_; }

 private:
  void addReturns(ceres::Problem& problem, PoseBlock& block);
  void addCorners(ceres::Problem& problem, PoseBlock& block);
  void addPriors(ceres::Problem& problem);
  bool covarianceOf(double* block, double* row_major);
  void build(ceres::Problem& problem);
  double minimise(ceres::Problem& problem, ceres::LinearSolverType solver, double tolerance);
  void measureNoise();
  std::vector<double> distances(const PoseBlock& block) const;
  std::vector<double> rangeErrors(const PoseBlock& block) const;  // in sigmas, without sign
  double sigma(const PoseBlock& block, const BoardReturn& from) const;

  const CameraLens& lens_;
  const CalibrationOptions options_;
  const std::vector<Eigen::Vector3d> corners_;
  std::vector<PoseBlock> blocks_;
  Transform T_camera_lidar_;
  Chart x_{};
  std::map<int, double> offsets_;
  double scale_ = 0.0, pixel_sigma_;
};

}  // namespace field_fusion::core
