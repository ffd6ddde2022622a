#pragma once
// What the calibrations write: a launch file and a YAML file; calibrate_lidar_camera a picture of each pose and a table, too.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "field_fusion/core/calib/extrinsics.h"

namespace field_fusion {

struct CalibrationFrames {
  std::string camera, lidar;
};

inline std::ofstream opened(const std::filesystem::path& file) {
  std::ofstream out(file);
  if (!out) throw std::runtime_error("cannot write " + file.string());
  out.precision(9);
  return out;
}

/// `program` found the camera in the frame of the other sensor.
inline void writeLaunch(const std::filesystem::path& file, const std::string& program, const core::Transform& T_sensor_camera,
                        const std::string& sensor, const std::string& camera) {
  const Eigen::Vector3d p = T_sensor_camera.translation();
  const Eigen::Quaterniond q(T_sensor_camera.linear());
  std::ofstream out = opened(file);
  std::string node = sensor;  // names of nodes have no slash, those of frames may
  std::replace(node.begin(), node.end(), '/', '_');
  out << "<launch>\n  <!-- where " << program << " found the camera; nothing else may be a parent of its frame -->\n"
      << "  <node pkg=\"tf2_ros\" type=\"static_transform_publisher\" name=\"" << node << "_to_camera\"\n        args=\""
      << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << ' ' << sensor
      << ' ' << camera << "\"/>\n</launch>\n";
}

template <class Matrix>
void writeMatrix(std::ostream& out, const char* name, const Matrix& matrix) {
  out << name << ":\n";
  for (int i = 0; i < matrix.rows(); ++i) {
    out << "  - [";
    for (int k = 0; k < matrix.cols(); ++k) out << (k ? ", " : "") << matrix(i, k);
    out << "]\n";
  }
}

inline void writeYaml(const std::filesystem::path& file, const core::Calibration& found,
                      const CalibrationFrames& frames) {
  std::ofstream out = opened(file);
  out << "camera_frame: " << frames.camera << "\nlidar_frame: " << frames.lidar << "\n";
  writeMatrix(out, "T_camera_lidar", found.T_camera_lidar.matrix());
  out << "# of turns [rad] about and shifts [m] along the LiDAR's axes\n";
  writeMatrix(out, "covariance", found.covariance);
  out << "range_offsets:  # m, measured less true, of each laser\n";
  for (const auto& [laser, offset] : found.offsets) out << "  " << laser << ": " << offset << "\n";
  out << "range_scale: " << found.scale << "  # measured over true, less 1\n";
  out << "corner_noise: " << found.pixel_sigma << "  # px\nrange_noise: " << found.range_sigma << "  # m\nposes:\n";
  for (const core::PoseResidual& pose : found.poses)
    out << "  - {name: " << pose.name << ", used: " << (pose.used ? "true" : "false") << ", returns: " << pose.returns
        << ", mean: " << pose.mean << ", rms: " << pose.rms << ", reprojection: " << pose.reprojection << "}\n";
}

/// As Fig. 4b of paper 004: the LiDAR's points on the picture, those of the board in green in a box.
inline void drawOverlay(cv::Mat& image, const core::Cloud& cloud, const std::vector<core::BoardReturn>& board,
                        const core::CameraLens& lens, const core::Transform& T_camera_lidar) {
  const auto pixel = [&](const Eigen::Vector3d& p, cv::Point& out) {
    const Eigen::Vector3d c = T_camera_lidar * p;
    if (!(c.z() > 0.1) || c.head<2>().norm() > 1.5 * c.z()) return false;  // beyond, a lens model may fold back
    const Eigen::Vector2d at = lens.project<double>(c);
    out = cv::Point(cvRound(at.x()), cvRound(at.y()));
    return cv::Rect({}, image.size()).contains(out);
  };
  cv::Point at;
  for (const core::Point& p : cloud)
    if (pixel(p.position().cast<double>(), at)) cv::circle(image, at, 1, {60, 120, 255}, cv::FILLED);
  std::vector<cv::Point> on;
  for (const core::BoardReturn& from : board)
    if (pixel(from.position, at)) cv::circle(image, at, 2, {80, 255, 80}, cv::FILLED), on.push_back(at);
  if (!on.empty()) cv::rectangle(image, cv::boundingRect(on) + cv::Size(6, 6) - cv::Point(3, 3), {80, 255, 80}, 1);
}

inline void printTransform(const char* name, const core::Transform& T) {
  const Eigen::Vector3d p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  std::printf("%s: translation %.4f %.4f %.4f m, quaternion (x y z w) %.5f %.5f %.5f %.5f\n", name, p.x(), p.y(), p.z(), q.x(),
              q.y(), q.z(), q.w());
}

inline void printTable(const core::Calibration& found) {
  std::printf("%-22s %8s %10s %10s %14s\n", "pose", "returns", "mean", "rms", "reprojection");
  for (const core::PoseResidual& pose : found.poses)
    std::printf("%-22s %8zu %7.1f mm %7.1f mm %11.2f px%s\n", pose.name.c_str(), pose.returns, 1e3 * pose.mean,
                1e3 * pose.rms, pose.reprojection, pose.used ? "" : "  outlier, left out");
  printTransform("T_camera_lidar", found.T_camera_lidar);
  std::printf("standard deviations: %.3f deg, %.1f mm\n", core::degrees(found.rotationSigma()),
              1e3 * found.translationSigma());
}

}  // namespace field_fusion
