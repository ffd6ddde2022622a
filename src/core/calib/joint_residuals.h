#pragma once
// Residuals of the problem in joint_problem.h, for Ceres's automatic differentiation.
#include <ceres/rotation.h>

#include "field_fusion/core/calib/board.h"

namespace field_fusion::core {

/// p moved by x, see chart.h.
template <class T>
Eigen::Matrix<T, 3, 1> moved(const T* x, const Eigen::Matrix<T, 3, 1>& p) {
  Eigen::Matrix<T, 3, 1> out;
  ceres::AngleAxisRotatePoint(x, p.data(), out.data());
  return out + Eigen::Map<const Eigen::Matrix<T, 3, 1>>(x + 3);
}

/// The board's plane and a ray or point of the LiDAR, moved by what is searched.
template <class T>
struct Meeting {
  using V = Eigen::Matrix<T, 3, 1>;
  V normal, from, to, middle;  // all in the camera's frame; the ray goes from the LiDAR to `to`

  Meeting(const Transform& T_camera_lidar, const Transform& T_camera_board, const Eigen::Vector3d& p, const T* lidar,
          const T* board) {
    const V origin = moved<T>(board, V::Zero());
    normal = T_camera_board.linear().cast<T>() * (moved<T>(board, V::UnitZ()) - origin);
    middle = T_camera_board.linear().cast<T>() * origin + T_camera_board.translation().cast<T>();
    const auto in_camera = [&](const V& q) {
      return V(T_camera_lidar.linear().cast<T>() * moved<T>(lidar, q) + T_camera_lidar.translation().cast<T>());
    };
    from = in_camera(V::Zero());
    to = in_camera(p.cast<T>());
  }
};

/// Distance of a return to the board. Its noise shrinks with the scale and as rays come to graze the board, so that
/// its least squares are biased: good to start with.
struct PointResidual {
  Transform T_camera_lidar, T_camera_board;
  Eigen::Vector3d p;
  double sigma;

  template <class T>
  bool operator()(const T* lidar, const T* board, T* out) const {
    const Meeting<T> m(T_camera_lidar, T_camera_board, p, lidar, board);
    *out = m.normal.dot(m.to - m.middle) / sigma;
    return true;
  }
};

/// Measured range less that at which the ray meets the board: the noise of what was measured, whatever is searched.
struct RangeResidual {
  Transform T_camera_lidar, T_camera_board;
  Eigen::Vector3d p;
  double sigma;

  template <class T>
  bool operator()(const T* lidar, const T* board, const T* offset, const T* scale, T* out) const {
    const double measured = p.norm();
    const Meeting<T> m(T_camera_lidar, T_camera_board, p / measured, lidar, board);
    const T range = m.normal.dot(m.middle - m.from) / m.normal.dot(m.to - m.from);
    *out = (measured - (1.0 + *scale) * range - *offset) / sigma;
    return true;
  }
};

struct CornerResidual {
  const CameraLens& lens;
  Transform T_camera_board;
  Eigen::Vector3d corner;
  Eigen::Vector2d pixel;
  double sigma;

  template <class T>
  bool operator()(const T* board, T* out) const {
    using V = Eigen::Matrix<T, 3, 1>;
    const V p = T_camera_board.linear().cast<T>() * moved<T>(board, V(corner.cast<T>())) +
                T_camera_board.translation().cast<T>();
    Eigen::Map<Eigen::Matrix<T, 2, 1>> difference(out);
    difference = (lens.project<T>(p) - pixel.cast<T>()) / sigma;
    return true;
  }
};

struct Prior {
  double sigma;

  template <class T>
  bool operator()(const T* x, T* out) const {
    *out = *x / sigma;
    return true;
  }
};

}  // namespace field_fusion::core
