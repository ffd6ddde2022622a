#include <Eigen/Eigenvalues>

#include <cstdio>

#include "field_fusion/core/calib/extrinsics.h"

namespace field_fusion::core {
namespace {

const double kLeastTurn = std::sin(radians(3.0));  // root mean square by which normals must leave a plane
constexpr double kLeastLever = 1e-3;               // of a motion of unit size, root mean square seen by the returns

std::string text(const char* form, const Eigen::Vector3d& v) {
  char out[200];
  std::snprintf(out, sizeof out, form, v.x(), v.y(), v.z());
  return out;
}

/// In the camera's frame. One plane tells of a shift along its normal alone.
std::string alikeNormals(const std::vector<CalibrationPose>& poses) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const CalibrationPose& pose : poses) {
    const Eigen::Vector3d normal = pose.view.T_camera_board.linear().col(2);
    squares += normal * normal.transpose() / static_cast<double>(poses.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(squares);
  const Eigen::Array3d spread = eigen.eigenvalues().array().max(0.0).sqrt();
  if (spread[1] < kLeastTurn)
    return "all boards are parallel, so that shifts along them stay unknown: turn the board about two axes";
  if (spread[0] < kLeastTurn)
    return text("all boards are turned about one axis, (%.2f, %.2f, %.2f) of the camera, so that a shift along it stays "
                "unknown: turn the board about a second axis",
                eigen.eigenvectors().col(0));
  return "";
}

/// What a motion (turn, shift) of the LiDAR changes in the returns' distances to their boards; turns count by the
/// mean range.
std::string unseenMotion(const std::vector<CalibrationPose>& poses, const Transform& T_camera_lidar) {
  double ranges = 0, count = 0;
  for (const CalibrationPose& pose : poses)
    for (const BoardReturn& from : pose.returns) ranges += from.position.norm(), ++count;
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  for (const CalibrationPose& pose : poses)
    for (const BoardReturn& from : pose.returns) {
      const Eigen::Vector3d normal =
          T_camera_lidar.linear().transpose() * pose.view.T_camera_board.linear().col(2);
      Eigen::Matrix<double, 6, 1> seen;
      seen << from.position.cross(normal) * count / ranges, normal;
      squares += seen * seen.transpose() / count;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(squares);
  if (eigen.eigenvalues()[0] >= kLeastLever * kLeastLever) return "";
  const Eigen::Matrix<double, 6, 1> weak = eigen.eigenvectors().col(0);
  return text("the returns leave a motion of the LiDAR unknown: turn about (%.2f, %.2f, %.2f)", weak.head<3>()) +
         text(" with a shift along (%.2f, %.2f, %.2f) of its axes: place and turn the board more differently",
              weak.tail<3>());
}

}  // namespace

std::string degenerate(const std::vector<CalibrationPose>& poses, const Transform& T_camera_lidar) {
  constexpr std::size_t kFewest = 3;
  if (poses.size() < kFewest)
    return std::to_string(poses.size()) + (poses.size() == 1 ? " pose" : " poses") +
           " of the board; three at least, turned about two axes, tell where the LiDAR is";
  const std::string alike = alikeNormals(poses);
  return alike.empty() ? unseenMotion(poses, T_camera_lidar) : alike;
}

}  // namespace field_fusion::core
