#include "field_fusion/core/cloud/ground.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/cloud/cell_grid.h"

namespace field_fusion::core {
namespace {

/// Times as bright as the ground would be if hit squarely: no speckle reaches that.
constexpr double kBrighter = 2.0;

Eigen::Vector3d position(const Point& p) { return p.position().cast<double>(); }

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Ground failed(GroundFault fault) {
  Ground out;
  out.fault = fault;
  return out;
}

}  // namespace

const char* describe(GroundFault fault) {
  switch (fault) {
    case GroundFault::kNone:
      return "";
    case GroundFault::kTooFewPoints:
      return "fewer points than a ground plane needs";
    case GroundFault::kDegenerate:
      return "the points lie on a line or in one place";
    case GroundFault::kTilt:
      return "every plane is tilted by more than max_tilt";
    case GroundFault::kHeight:
      return "the best plane is out of height_tolerance, or above the sensor";
    case GroundFault::kHeightChange:
      return "the height of the sensor changed by more than max_height_change";
    case GroundFault::kTooFewInliers:
      return "the best plane has fewer than min_inliers points";
    case GroundFault::kLowConfidence:
      return "the best plane's confidence is below min_confidence";
  }
  return "";
}

void GroundFinder::setParams(const GroundParams& params) { params_ = checked(params); }

Ground GroundFinder::run(const Cloud& cloud, double stamp, Cloud& ground, Cloud& obstacles,
                         const Eigen::Vector3d& up) {
  if (!(std::abs(up.norm() - 1.0) < 1e-3))
    throw std::invalid_argument("the up direction is not a unit vector");
  if (!(stamp >= last_stamp_ && stamp - last_stamp_ <= params_.memory)) reset();
  usable_.clear();
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (usable(cloud[i])) usable_.push_back(i);

  Ground result = find(cloud, up);
  if (!result.found()) result = failed(result.fault);
  result.unusable = cloud.size() - usable_.size();
  measure(cloud, result);
  split(cloud, brightest(cloud, result), ground, obstacles);
  if (result.found()) last_stamp_ = stamp, last_height_ = result.plane.offset;
  return result;
}

Ground GroundFinder::find(const Cloud& cloud, const Eigen::Vector3d& up) {
  const auto least = static_cast<std::size_t>(params_.min_inliers);
  if (usable_.size() < least) return failed(GroundFault::kTooFewPoints);
  Ground result;
  const auto accept = [&](Plane& plane) { return judge(plane, up) == GroundFault::kNone; };
  search_.sample(cloud, usable_, static_cast<unsigned>(params_.seed));
  if (search_.run(params_.distance, params_.tries, std::ref(accept), result.plane)) {
    refine(cloud, up, result);
    if (!result.found()) return result;  // the triple only just kept the bounds
    count(cloud, result);
    if (result.inliers >= least && result.confidence >= params_.min_confidence) return result;
  }
  result.fault = faultOfBest(up);
  if (result.found())
    result.fault = result.inliers < least ? GroundFault::kTooFewInliers : GroundFault::kLowConfidence;
  return result;
}

/// Turns the normal up and names the first bound that the plane breaks.
GroundFault GroundFinder::judge(Plane& plane, const Eigen::Vector3d& up) const {
  if (plane.normal.dot(up) < 0.0) plane = {-plane.normal, -plane.offset};
  if (angleBetween(plane.normal, up) > radians(params_.max_tilt)) return GroundFault::kTilt;
  const double height = plane.offset;
  const bool as_expected = std::abs(height - params_.sensor_height) <= params_.height_tolerance;
  if (params_.sensor_height > 0.0 ? !as_expected : height <= 0.0) return GroundFault::kHeight;
  const bool remembered = !std::isnan(last_stamp_);
  if (remembered && std::abs(height - last_height_) > params_.max_height_change)
    return GroundFault::kHeightChange;
  return GroundFault::kNone;
}

/// What the best of all planes that are not too tilted breaks: the height bounds only narrow the choice, so
/// without a second search nobody could tell that the floor was there at another height.
GroundFault GroundFinder::faultOfBest(const Eigen::Vector3d& up) {
  bool spanned = false;
  const auto accept = [&](Plane& plane) { return spanned = true, judge(plane, up) != GroundFault::kTilt; };
  Plane best;
  if (search_.run(params_.distance, params_.tries, std::ref(accept), best)) return judge(best, up);
  return spanned ? GroundFault::kTilt : GroundFault::kDegenerate;
}

void GroundFinder::refine(const Cloud& cloud, const Eigen::Vector3d& up, Ground& result) const {
  PlaneFit fit(position(cloud[usable_.front()]));
  for (const std::uint32_t i : usable_)
    if (std::abs(result.plane.height(position(cloud[i]))) <= params_.distance) fit.add(position(cloud[i]));
  const PlaneFit::Result fitted = fit.solve();
  result.plane = fitted.plane;
  result.fault = judge(result.plane, up);
  result.tilt = angleBetween(result.plane.normal, up);
  result.thickness = fitted.thickness;
  result.confidence = fitted.width > 0.0 ? 1.0 - fitted.thickness / fitted.width : 0.0;
}

void GroundFinder::count(const Cloud& cloud, Ground& result) const {
  for (const std::uint32_t i : usable_) {
    const double height = result.plane.height(position(cloud[i]));
    result.inliers += std::abs(height) <= params_.distance;
    result.below += height < -params_.distance;
  }
  const auto on = static_cast<double>(result.inliers), below = static_cast<double>(result.below);
  result.confidence *= on > 0.0 ? on / (on + below) : 0.0;
}

void GroundFinder::measure(const Cloud& cloud, const Ground& result) {
  if (result.found() && params_.method == GroundMethod::kSurface) {
    const SurfaceLimits limits{radians(params_.max_slope), params_.max_step};
    surface_.measure(cloud, usable_, result.plane, limits, heights_);
    return;
  }
  heights_.clear();
  for (const std::uint32_t i : usable_) heights_.push_back(result.plane.height(position(cloud[i])));
}

/// Intensity that no ground reaches; infinite where brightness tells nothing.
double GroundFinder::brightest(const Cloud& cloud, const Ground& result) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!(result.plane.offset > 0.0) || params_.bright == 0.0) return kNone;
  shades_.clear();
  for (std::size_t k = 0; k < usable_.size(); ++k) {
    const Point& point = cloud[usable_[k]];
    if (std::abs(heights_[k]) > params_.distance || !std::isfinite(point.intensity)) continue;
    shades_.push_back(point.intensity * point.position().norm());
  }
  if (shades_.empty()) return kNone;
  const auto median = shades_.begin() + static_cast<std::ptrdiff_t>(shades_.size() / 2);
  std::nth_element(shades_.begin(), median, shades_.end());
  return std::max(params_.bright, kBrighter * *median / result.plane.offset);
}

void GroundFinder::split(const Cloud& cloud, double brightest, Cloud& ground, Cloud& obstacles) const {
  ground.clear();
  obstacles.clear();
  for (std::size_t k = 0; k < usable_.size(); ++k) {
    const Point& point = cloud[usable_[k]];
    const double height = heights_[k];
    if (std::abs(height) <= params_.distance && !(point.intensity >= brightest))
      ground.push_back(point);
    else if (!(height < 0.0) || !params_.drop_below)
      obstacles.push_back(point);
  }
}

}  // namespace field_fusion::core
