#include "field_fusion/core/match/outline.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/match/box_fit.h"

namespace field_fusion::core {
namespace {

constexpr double kTooLarge = 2.0;    // spreads by which a body may be larger than its class
constexpr double kSlack = 0.2;       // [m] that errors of ranges may add
constexpr std::size_t kBins = 3600;  // of elevation, 0.05 degrees each: rows lie at least 0.1 apart

struct Span {
  double low = kNaN, high = kNaN;
};

Span heightsOf(const std::vector<Point>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const Point& a, const Point& b) { return a.z < b.z; });
  return {low->z, high->z};
}

/// Height at which a line of sight, up by the tangent `edge` in the view frame, passes a body that is seen in
/// the middle of the box. `upper`: the edge above which there is nothing of it.
double heightAt(double edge, bool upper, const CameraTarget& target, const Transform& T_lidar_view,
                const Eigen::Vector2d& centre, double half_depth) {
  const double aside = 0.5 * (target.box.left + target.box.right);
  const Eigen::Vector3d ray = T_lidar_view.linear() * Eigen::Vector3d(1.0, aside, edge);
  const Eigen::Vector3d camera = T_lidar_view.translation();
  const double slope = ray.z() / ray.head<2>().norm(), away = (centre - camera.head<2>()).norm();
  const bool near_side = (slope > 0.0) == upper;
  return camera.z() + slope * std::max(0.0, away + (near_side ? -half_depth : half_depth));
}

/// As the camera sees it where it can, else what the points span.
Span heightsOf(const std::vector<Point>& points, const CameraTarget& target, const Transform& T_lidar_view,
               const Eigen::Vector2d& centre, double half_depth) {
  Span span = heightsOf(points);
  if (!target.box.known() || !T_lidar_view.matrix().allFinite()) return span;
  Span seen = span;
  if (!(target.cut & kCutTop))
    seen.high = heightAt(target.box.top, true, target, T_lidar_view, centre, half_depth);
  if (!(target.cut & kCutBottom))
    seen.low = heightAt(target.box.bottom, false, target, T_lidar_view, centre, half_depth);
  return seen.low < seen.high ? seen : span;
}

/// Rows of the sensor, told by the elevations of what they returned: runs of bins that hold any.
std::size_t rowsOf(const std::vector<Point>& points) {
  std::bitset<kBins + 2> hit;
  for (const Point& p : points) {
    const float elevation = std::atan2(p.z, std::hypot(p.x, p.y));
    if (!std::isfinite(elevation)) continue;
    hit.set(1 + static_cast<std::size_t>((elevation / static_cast<float>(M_PI) + 0.5f) * kBins));
  }
  return (hit & ~(hit << 1)).count();
}

/// [m^2] along the line of sight. No body is quite the cylinder of its class: a return comes from anywhere
/// between its near side and its middle (a mast, a topmark), and the nearest of n is 1 / (n + 1) of the way.
/// What one row of the sensor returns is all of one height, so all of one part: n counts rows.
Eigen::Matrix2d depthOfNearest(const Eigen::Vector2d& centre, double radius, std::size_t count) {
  const Eigen::Vector2d depth = radius / (static_cast<double>(count) + 1.0) * centre.normalized();
  return depth * depth.transpose();
}

/// Horizontal centre with its covariance, and size.
Outline upright(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance, const Eigen::Vector2d& size,
                const Span& span, double noise) {
  Outline out;
  out.centre << centre, 0.5 * (span.low + span.high);
  out.size << size, span.high - span.low;
  out.covariance.setZero();
  out.covariance.topLeftCorner<2, 2>() = 0.5 * (covariance + covariance.transpose());
  out.covariance(2, 2) = noise * noise + out.size.z() * out.size.z() / 12.0;
  return out;
}

}  // namespace

void OutlineFitter::setParams(const ShapeParams& params, double noise) {
  params_ = params;
  noise_ = noise;
}

Eigen::Vector3d nearestOf(std::vector<Point>& seen) {
  const auto place = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 100);
  std::nth_element(seen.begin(), place, seen.end(), [](const Point& a, const Point& b) {
    return a.position().squaredNorm() < b.position().squaredNorm();
  });
  return place->position().cast<double>();
}

std::optional<Outline> OutlineFitter::run(std::vector<Point>& seen, const CameraTarget& target,
                                          const Transform& T_view_lidar) {
  const ClassShape shape = shapeOf(target.label, params_);
  if (!shape.isKnown() || seen.empty()) return std::nullopt;
  return shape.isRound() ? round(seen, shape, target, T_view_lidar.inverse())
                         : box(seen, shape, target, T_view_lidar.inverse());
}

std::optional<Outline> OutlineFitter::round(const std::vector<Point>& seen, const ClassShape& shape,
                                            const CameraTarget& target, const Transform& T_lidar_view) {
  Eigen::AlignedBox2f seen_box;
  for (const Point& p : seen) seen_box.extend(Eigen::Vector2f(p.x, p.y));
  if (seen_box.sizes().maxCoeff() > shape.diameter * (1.0 + kTooLarge * params_.size_spread) + kSlack)
    return std::nullopt;
  const RoundFit fit =
      round_.fit(seen, {0.5 * shape.diameter, 0.5 * shape.net, params_.size_spread, noise_});
  if (!fit.centre.allFinite()) return std::nullopt;
  const Span span = heightsOf(seen, target, T_lidar_view, fit.centre, fit.radius);
  const Eigen::Vector2d size = Eigen::Vector2d::Constant(2.0 * fit.radius);
  const Eigen::Matrix2d covariance = fit.covariance + depthOfNearest(fit.centre, fit.radius, rowsOf(seen));
  Outline out = upright(fit.centre, covariance, size, span, noise_);
  const double away = std::max(0.0, fit.centre.norm() - fit.radius);
  out.face << away * fit.centre.normalized(), std::clamp(0.0, span.low, span.high);
  return out;
}

Outline OutlineFitter::box(std::vector<Point>& seen, const ClassShape& shape, const CameraTarget& target,
                           const Transform& T_lidar_view) {
  const BoxFit fit = completed(box_.fit(seen.data(), seen.size()), shape, params_.size_spread, noise_);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(fit.yaw).toRotationMatrix();
  const Eigen::Vector2d sight = fit.centre.normalized();
  const double half_depth = 0.5 * (sight.transpose() * turn * fit.size.asDiagonal()).cwiseAbs().sum();
  const Span span = heightsOf(seen, target, T_lidar_view, fit.centre, half_depth);
  Outline out = upright(fit.centre, fit.covariance, turn.cwiseAbs() * fit.size, span, noise_);
  out.face = nearestOf(seen);
  return out;
}

}  // namespace field_fusion::core
