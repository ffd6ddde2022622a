#pragma once
// What the spline of core/calib/camera_imu.h must fit. A block of points holds turn and place of the unit in
// the board's frame.
#include <ceres/cost_function.h>

#include <vector>

#include "field_fusion/core/calib/board.h"
#include "field_fusion/core/calib/pose_spline.h"

namespace field_fusion::core {

constexpr double kGravity = 9.80665;  // [m/s^2] standard; what it is elsewhere differs by 0.3 % at most

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

/// Corners of a picture, where the board is seen at the stamp shifted by t.
struct PictureResidual {
  const CameraLens& lens;
  const std::vector<Eigen::Vector3d>& corners;
  const std::vector<Eigen::Vector2d>& pixels;
  Eigen::Matrix3d R_board_reference;
  Transform T_camera_imu;
  double u, step;  // in the segment; its length [s]
  double sigma;    // [px]

  template <class T>
  bool operator()(const T* p0, const T* p1, const T* p2, const T* p3, const T* p4, const T* p5, const T* x,
                  const T* t, T* out) const {
    const T* points[] = {p0, p1, p2, p3, p4, p5};
    const Eigen::Matrix<T, 6, 1> at = splineSum(points, splineWeights(T(u + t[0] / step), 0));
    const Eigen::Matrix<T, 3, 3> R_board_imu =
        R_board_reference.cast<T>() * rotationOf<T>(at.template head<3>());
    const Eigen::Map<const Vector3<T>> turn(x), shift(x + 3);
    const Eigen::Matrix<T, 3, 3> linear = T_camera_imu.linear().cast<T>();
    const Eigen::Matrix<T, 3, 3> R_camera_board = linear * rotationOf<T>(turn) * R_board_imu.transpose();
    const Vector3<T> origin =
        linear * shift + T_camera_imu.translation().cast<T>() - R_camera_board * at.template tail<3>();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3<T> p = R_camera_board * corners[i].cast<T>() + origin;
      if (!(p.z() > 1e-3)) return false;  // behind the camera: no way to go
      Eigen::Map<Eigen::Matrix<T, 2, 1>> difference(out + 2 * i);
      difference = (lens.project<T>(p) - pixels[i].cast<T>()) / sigma;
    }
    return true;
  }
};

/// A bias that goes linearly from one block to the next; of each, gyroscope then accelerometer.
template <class T>
Vector3<T> biasAt(const T* before, const T* after, double share, int first) {
  const Eigen::Map<const Vector3<T>> a(before + first), b(after + first);
  return a * (1.0 - share) + b * share;
}

struct GyroResidual {
  Eigen::Vector3d rate;
  double u, step, share, sigma;

  template <class T>
  bool operator()(const T* p0, const T* p1, const T* p2, const T* p3, const T* p4, const T* p5,
                  const T* before, const T* after, T* out) const {
    const T* points[] = {p0, p1, p2, p3, p4, p5};
    const Vector3<T> turn = splineSum(points, splineWeights(u, 0)).template head<3>();
    const Vector3<T> change = splineSum(points, splineWeights(u, 1)).template head<3>() / T(step);
    Eigen::Map<Vector3<T>> difference(out);
    difference = (bodyRate<T>(turn, change) + biasAt(before, after, share, 0) - rate.cast<T>()) / T(sigma);
    return true;
  }
};

struct AccelResidual {
  Eigen::Vector3d force;
  Eigen::Matrix3d R_board_reference;
  Eigen::Quaterniond R_board_up;
  double u, step, share, sigma;

  template <class T>
  bool operator()(const T* p0, const T* p1, const T* p2, const T* p3, const T* p4, const T* p5,
                  const T* before, const T* after, const T* tilt, T* out) const {
    const T* points[] = {p0, p1, p2, p3, p4, p5};
    const Vector3<T> turn = splineSum(points, splineWeights(u, 0)).template head<3>();
    const Vector3<T> acceleration =
        splineSum(points, splineWeights(u, 2)).template tail<3>() / T(step * step);
    const Vector3<T> up =
        R_board_up.toRotationMatrix().cast<T>() * (rotationOf<T>({tilt[0], tilt[1], T(0.0)}).col(2));
    const Vector3<T> in_reference =
        R_board_reference.transpose().cast<T>() * (acceleration + up * T(kGravity));
    Eigen::Map<Vector3<T>> difference(out);
    difference =
        (rotationOf<T>(turn).transpose() * in_reference + biasAt(before, after, share, 3) - force.cast<T>()) /
        T(sigma);
    return true;
  }
};

/// From one block of biases to the next.
struct BiasWalk {
  double gyro, accel;  // standard deviations

  template <class T>
  bool operator()(const T* before, const T* after, T* out) const {
    for (int i = 0; i < 6; ++i) out[i] = (after[i] - before[i]) / (i < 3 ? gyro : accel);
    return true;
  }
};

// With derivatives by automatic differentiation, in a file of its own, for it takes long to compile.
ceres::CostFunction* costOf(const PictureResidual& residual);
ceres::CostFunction* costOf(const GyroResidual& residual);
ceres::CostFunction* costOf(const AccelResidual& residual);
ceres::CostFunction* costOf(const BiasWalk& residual);

}  // namespace field_fusion::core
