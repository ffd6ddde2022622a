#pragma once
// Bodies as a LiDAR and a camera see them, for the tests of matching.
#include <algorithm>
#include <vector>

#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/lidar_target.h"

namespace field_fusion::test {

/// An upright box in the LiDAR's frame. [m]
struct Solid {
  Eigen::Vector3d low, high;
  Eigen::Vector3d centre() const { return 0.5 * (low + high); }
};

/// 0.5 m wide, 1.7 m high, 0.3 m deep, its middle at the LiDAR's height.
inline Solid personAt(double x, double y) {
  return {{x - 0.15, y - 0.25, -0.85}, {x + 0.15, y + 0.25, 0.85}};
}

/// A camera at `place` of the LiDAR's frame that looks along its x axis.
inline core::Transform lookingAhead(const Eigen::Vector3d& place) {
  core::Transform T_lidar_camera = core::Transform::Identity();
  T_lidar_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_lidar_camera.translation() = place;
  return T_lidar_camera;
}

inline core::CameraView viewFrom(const core::Transform& T_lidar_camera) {
  return {{}, core::viewFromOptical() * T_lidar_camera.inverse()};
}

/// Points of the side that faces the LiDAR, `step` [m] apart, appended; the cluster that they are.
inline core::Cluster scan(const std::vector<Solid>& bodies, std::vector<core::Point>& points,
                          double step = 0.05) {
  core::Cluster out;
  out.points = {static_cast<std::uint32_t>(points.size()), 0};
  for (const Solid& body : bodies)
    for (double y = body.low.y(); y <= body.high.y() + 1e-9; y += step)
      for (double z = body.low.z(); z <= body.high.z() + 1e-9; z += step) {
        core::Point point;
        point.x = static_cast<float>(body.low.x());
        point.y = static_cast<float>(y);
        point.z = static_cast<float>(z);
        points.push_back(point);
      }
  out.points.count = static_cast<std::uint32_t>(points.size()) - out.points.first;
  core::describe(out, points.data() + out.points.first, out.points.count, nullptr);
  return out;
}

/// The tight box around the body in the image, with the true range of its near side.
inline core::CameraTarget seenBy(const core::Transform& T_lidar_camera, const Solid& body, int id,
                                 double range_sigma) {
  const core::Transform T_camera_lidar = T_lidar_camera.inverse();
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p = T_camera_lidar * Eigen::Vector3d((corner & 1 ? body.high : body.low).x(),
                                                               (corner & 2 ? body.high : body.low).y(),
                                                               (corner & 4 ? body.high : body.low).z());
    const Eigen::Vector2d pixel(p.x() / p.z(), p.y() / p.z());
    low = low.cwiseMin(pixel), high = high.cwiseMax(pixel);
  }
  const auto ray = [](const Eigen::Vector2d& pixel) {
    return Eigen::Vector3d(pixel.x(), pixel.y(), 1.0).normalized();
  };
  core::CameraTarget out;
  out.id = id;
  out.label = "person";
  out.score = 0.9;
  out.ray_range =
      (T_camera_lidar * Eigen::Vector3d(body.low.x(), body.centre().y(), body.centre().z())).norm();
  out.range_sigma = range_sigma;
  const Eigen::Vector3d middle = ray(0.5 * (low + high));
  core::look(out, middle, ray(low), ray(high));
  core::carryToLidar(out, middle, T_lidar_camera);
  return out;
}

}  // namespace field_fusion::test
