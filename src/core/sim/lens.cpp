#include "field_fusion/core/sim/lens.h"

#include <algorithm>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

constexpr double kWidest = 400.0;  // square of tan(87 deg)

/// Where the distorted radius stops to grow, as the square of the undistorted one.
double widestOf(const CameraParams& p) {
  const auto grows = [&](double r2) { return 1 + r2 * (3 * p.k1 + r2 * (5 * p.k2 + r2 * 7 * p.k3)) > 0; };
  double r2 = 0.0;
  constexpr double kStep = 1.005;
  for (double next = 1e-4; next < kWidest && grows(next); next *= kStep) r2 = next;
  return r2;
}

}  // namespace

Lens::Lens(const CameraParams& params)
    : params_(params), width_(params.width), height_(params.height), widest_(widestOf(params)) {
  rays_.reserve(static_cast<std::size_t>(width_) * height_);
  Eigen::Vector2d row_start = Eigen::Vector2d::Zero();
  for (int v = 0; v < height_; ++v) {
    Eigen::Vector2d p = row_start;
    for (int u = 0; u < width_; ++u) {
      p = undistorted({u, v}, p);
      if (u == 0) row_start = p;
      rays_.push_back(Eigen::Vector3d(p.x(), p.y(), 1.0).normalized().cast<float>());
    }
  }
}

Eigen::Vector2d Lens::distorted(const Eigen::Vector2d& p, Eigen::Matrix2d* jacobian) const {
  const CameraParams& c = params_;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  if (jacobian) {
    const double slope = 2 * (c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3));  // of radial, over x or y
    const double cross = x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y;
    *jacobian << radial + x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x, cross, cross,
        radial + y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  }
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

/// Newton's method, from the neighbour and, if that fails, from the axis.
Eigen::Vector2d Lens::undistorted(const Eigen::Vector2d& pixel, Eigen::Vector2d start) const {
  const Eigen::Vector2d wanted((pixel.x() - params_.cx) / params_.fx, (pixel.y() - params_.cy) / params_.fy);
  for (int trial = 0; trial < 2; ++trial) {
    Eigen::Vector2d p = trial == 0 ? start : Eigen::Vector2d(Eigen::Vector2d::Zero());
    for (int i = 0; i < 60; ++i) {
      Eigen::Matrix2d jacobian;
      const Eigen::Vector2d error = distorted(p, &jacobian) - wanted;
      if (error.norm() < 1e-10 && p.squaredNorm() <= widest_) return p;
      Eigen::Vector2d step = jacobian.inverse() * error;
      if (!step.allFinite()) break;
      const double length = step.norm();
      if (length > 0.3) step *= 0.3 / length;  // the inverse is flat near the rim
      p -= step;
    }
  }
  throw std::invalid_argument("the distortion folds the picture: no ray reaches pixel (" +
                              std::to_string(static_cast<int>(pixel.x())) + ", " +
                              std::to_string(static_cast<int>(pixel.y())) + ")");
}

Eigen::Vector2d Lens::project(const Eigen::Vector3d& p) const {
  if (!(p.z() > 0.0)) return Eigen::Vector2d::Constant(kNaN);
  Eigen::Vector2d at;
  formula<double>().pixel(p.x() / p.z(), p.y() / p.z(), at.x(), at.y());
  return at;
}

Eigen::Vector3f Lens::ray(int u, int v, float right, float down) const {
  const auto flat = [&](int i, int j) {
    const Eigen::Vector3f& r = ray(i, j);
    return Eigen::Vector2f(r.head<2>() / r.z());
  };
  const int u0 = std::max(0, u - 1), u1 = std::min(width_ - 1, u + 1);
  const int v0 = std::max(0, v - 1), v1 = std::min(height_ - 1, v + 1);
  const Eigen::Vector2f p = flat(u, v) + right / static_cast<float>(u1 - u0) * (flat(u1, v) - flat(u0, v)) +
                            down / static_cast<float>(v1 - v0) * (flat(u, v1) - flat(u, v0));
  return Eigen::Vector3f(p.x(), p.y(), 1.f).normalized();
}

Transform sensorToOptical() {
  Transform T = Transform::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T;
}

}  // namespace field_fusion::core::sim
