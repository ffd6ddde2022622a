#include "field_fusion/core/detect/ground_range.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr double kMostRelativeSigma = 0.5;

double square(double x) { return x * x; }

}  // namespace

MonoRange rangeFromGround(const ImageBox& box, std::uint8_t cut, double input_scale, const Pinhole& camera,
                          const Plane& ground, const RangeParams& params) {
  if (!camera.known() || (cut & kCutBottom)) return {};
  const Eigen::Vector3d& up = ground.normal;
  const Eigen::Vector3d foot((box.centre().x - camera.cx) / camera.fx, (box.y_max - camera.cy) / camera.fy,
                             1);
  const double fall = -up.dot(foot);  // NaN fails the comparisons
  if (!(fall > 0 && ground.offset > 0)) return {};
  const Eigen::Vector3d contact = foot * (ground.offset / fall);
  const Eigen::Vector3d ahead = contact - up * up.dot(contact);  // normal of the body's upright near side
  const Eigen::Vector3d ray = bearing(box.centre(), camera).ray;
  if (!(ahead.dot(ray) > 0)) return {};

  const double pixel_part = std::abs(up.y()) * params.box_pixel_error / input_scale / (camera.fy * fall);
  const double tilt_part = foot.cross(up).norm() * radians(params.plane_tilt_sigma) / fall;
  const double relative = std::hypot(pixel_part, tilt_part, params.plane_height_sigma / ground.offset);
  if (!(relative <= kMostRelativeSigma)) return {};
  MonoRange result;
  result.range = ahead.dot(contact) / ahead.dot(ray);
  result.depth = result.range * ray.z();
  result.sigma = result.range * relative;
  result.edge = result.range * pixel_part;
  return std::isfinite(result.sigma) ? result : MonoRange{};
}

MonoRange combined(const MonoRange& a, const MonoRange& b) {
  if (!std::isfinite(a.sigma)) return b;
  if (!std::isfinite(b.sigma)) return a;
  const double of_a = square(b.sigma) / (square(a.sigma) + square(b.sigma)), of_b = 1 - of_a;
  const double shared = a.edge * b.edge;  // a lower edge brings both nearer
  const double apart =
      std::abs(a.range - b.range) / std::sqrt(square(a.sigma) + square(b.sigma) - 2 * shared);
  MonoRange result;
  result.depth = of_a * a.depth + of_b * b.depth;
  result.range = of_a * a.range + of_b * b.range;
  result.edge = of_a * a.edge + of_b * b.edge;
  result.sigma = std::sqrt(square(of_a * a.sigma) + square(of_b * b.sigma) + 2 * of_a * of_b * shared) *
                 std::max(1.0, apart);
  return result;
}

}  // namespace field_fusion::core
