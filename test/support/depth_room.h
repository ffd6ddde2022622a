#pragma once
// A depth camera over a level floor, in front of a wall, by analysis.
#include <functional>

#include "field_fusion/core/base/level.h"
#include "field_fusion/core/cloud/depth_scan.h"

namespace field_fusion::test {

/// The optical frame of a camera at (x, 0, height) of a base on the ground, looking ahead and `down` [rad].
inline core::Transform cameraAt(double x, double height, double down) {
  core::Transform out = core::Transform::Identity();
  out.translation() << x, 0.0, height;
  out.rotate(Eigen::AngleAxisd(down, Eigen::Vector3d::UnitY()));
  Eigen::Matrix3d optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  out.rotate(Eigen::Quaterniond(optical));
  return out;
}

struct DepthRoom {
  int width = 640, height = 480;
  double focal = 400.0;
  double wall = 3.0;  ///< [m] ahead of the base; above `wall_height` one sees over it
  double wall_height = 1.0;
  double horizon = 50.0;
  core::Transform T_base_camera = cameraAt(0.3, 0.4, core::radians(15.0));
  core::Transform T_ground_base = core::Transform::Identity();  ///< level ground, z = 0
  std::vector<Eigen::AlignedBox3d> boxes;                       ///< on the ground

  /// Depth along the optical axis [m]; 0: nothing.
  double depth(int u, int v) const {
    const core::Transform T = T_ground_base * T_base_camera;
    const Eigen::Vector3d ray =
        T.linear() * Eigen::Vector3d((u - 0.5 * width) / focal, (v - 0.5 * height) / focal, 1.0);
    const Eigen::Vector3d from = T.translation();
    double nearest = horizon;
    if (ray.z() < 0.0) nearest = std::min(nearest, -from.z() / ray.z());
    const double to_wall = (wall - from.x()) / ray.x();
    if (to_wall > 0.0 && from.z() + to_wall * ray.z() < wall_height) nearest = std::min(nearest, to_wall);
    for (const auto& box : boxes) {
      const Eigen::Array3d a = (box.min() - from).array() / ray.array(),
                           b = (box.max() - from).array() / ray.array();
      const double in = a.min(b).maxCoeff(), out = a.max(b).minCoeff();
      if (in <= out && in > 0.0) nearest = std::min(nearest, in);
    }
    return nearest < horizon ? nearest : 0.0;
  }

  template <class Pixel>
  std::vector<Pixel> pixels(double unit) const {
    std::vector<Pixel> out;
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        out.push_back(static_cast<Pixel>(depth(u, v) / unit + (unit < 1.0 ? 0.5 : 0.0)));
    return out;
  }
  template <class Pixel>
  core::DepthImage<Pixel> image(const std::vector<Pixel>& pixels) const {
    return {width, height, pixels.data(), static_cast<std::size_t>(width),
            focal, focal,  0.5 * width,   0.5 * height};
  }
  core::ScanPlace place(double plane_height = 0.1) const {
    core::ScanPlace out;
    out.plane_height = plane_height;
    out.T_plane_base = core::overLevelPlane(T_ground_base, T_ground_base.translation().z() - plane_height);
    out.T_plane_sensor = out.T_plane_base * T_base_camera;
    return out;
  }
};

}  // namespace field_fusion::test
