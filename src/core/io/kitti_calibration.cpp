#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "field_fusion/core/io/kitti.h"

namespace field_fusion::core {
namespace {

using Lines = std::map<std::string, std::string>;  // what stands behind each key

Lines readLines(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  Lines lines;
  for (std::string line; std::getline(in, line);) {
    const std::size_t end = line.find_first_of(": \t");
    if (end != std::string::npos && end > 0) lines[line.substr(0, end)] = line.substr(end + 1);
  }
  return lines;
}

/// The row-major matrix under the first of the keys that the file has.
template <int Rows, int Cols>
Eigen::Matrix<double, Rows, Cols> matrix(const Lines& lines, const std::vector<std::string>& keys,
                                         const std::filesystem::path& file) {
  for (const std::string& key : keys) {
    const auto line = lines.find(key);
    if (line == lines.end()) continue;
    std::istringstream in(line->second);
    std::vector<double> values;
    for (double value; in >> value;) values.push_back(value);
    if (!in.eof() || values.size() != Rows * Cols)
      throw std::runtime_error(file.string() + ": " + key + " should be " + std::to_string(Rows * Cols) +
                               " numbers, has " + std::to_string(values.size()));
    return Eigen::Map<Eigen::Matrix<double, Rows, Cols, Eigen::RowMajor>>(values.data());
  }
  throw std::runtime_error(file.string() + ": no " + keys.front());
}

Transform rigid(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
                const std::string& what) {
  constexpr double kTolerance = 1e-3;  // KITTI writes seven digits
  if (!rotation.isUnitary(kTolerance) || rotation.determinant() < 0.0)
    throw std::runtime_error(what + " is no rotation");
  Transform transform = Transform::Identity();
  transform.linear() = rotation;
  transform.translation() = translation;
  return transform;
}

}  // namespace

KittiCalibration readKittiCalibration(const std::filesystem::path& file) {
  const Lines lines = readLines(file);
  const Eigen::Matrix<double, 3, 4> P = matrix<3, 4>(lines, {"P2"}, file);
  const Eigen::Matrix3d R = matrix<3, 3>(lines, {"R0_rect", "R_rect"}, file);
  const Eigen::Matrix<double, 3, 4> Tr = matrix<3, 4>(lines, {"Tr_velo_to_cam", "Tr_velo_cam"}, file);

  KittiCalibration out;
  out.camera = {P(0, 0), P(1, 1), P(0, 2), P(1, 2)};
  const Eigen::Matrix3d K = P.leftCols<3>();
  const Eigen::Matrix3d pinhole =
      (Eigen::Matrix3d() << K(0, 0), 0, K(0, 2), 0, K(1, 1), K(1, 2), 0, 0, 1).finished();
  if (!out.camera.known() || !K.isApprox(pinhole))
    throw std::runtime_error(file.string() + ": P2 is no pinhole camera");

  const Transform T_camera_reference(Eigen::Translation3d(K.inverse() * P.col(3)));
  const Transform T_rectified_raw = rigid(R, Eigen::Vector3d::Zero(), file.string() + ": R0_rect");
  const Transform T_raw_lidar = rigid(Tr.leftCols<3>(), Tr.col(3), file.string() + ": Tr_velo_to_cam");
  out.T_camera_lidar = T_camera_reference * T_rectified_raw * T_raw_lidar;
  return out;
}

}  // namespace field_fusion::core
