#include "field_fusion/core/match/obstacle_scan.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr float kFree = std::numeric_limits<float>::infinity();
constexpr double kCircle = radians(360.0);

}  // namespace

void ObstacleScanner::setParams(const ObstacleScanParams& params) {
  params_ = checked(params);
  const double round = std::fmod(params.azimuth_max - params.azimuth_min, 360.0);
  const double sector = round > 0.0 ? round : round + 360.0;
  const double steps = std::ceil(sector / params.azimuth_step - 1e-9);
  scan_.azimuth = radians(params.azimuth_min);
  scan_.step = radians(sector) / steps;
  scan_.ranges.resize(static_cast<std::size_t>(steps) + (sector < 360.0 ? 1 : 0));
}

const ObstacleScan& ObstacleScanner::run(const Cloud& points, bool looked, const Cloud& unclear) {
  std::fill(scan_.ranges.begin(), scan_.ranges.end(), looked ? kFree : kNaN);
  for (const auto& point : unclear) mark(point);
  const auto met = [](float range) { return range < kFree; };
  std::replace_if(scan_.ranges.begin(), scan_.ranges.end(), met, kNaN);
  for (const auto& point : points) mark(point);
  return scan_;
}

void ObstacleScanner::mark(const Point& point) {
  const double range = std::hypot(point.x, point.y);
  // as floats, because so the reader compares them with the limits of the message
  const float reading = std::max(static_cast<float>(range), static_cast<float>(params_.range_min));
  if (!(reading < static_cast<float>(params_.range_max))) return;  // nor one that is NaN
  const double azimuth = std::atan2(point.y, point.x) - scan_.azimuth;
  const double reach = std::atan2(params_.point_radius, range);
  for (const double turn : {-2.0, -1.0, 0.0, 1.0, 2.0}) {  // azimuth_min may be a turn away
    const double at = azimuth + turn * kCircle;
    const auto ray = [&](double angle) { return static_cast<long>(std::lround(angle / scan_.step)); };
    const long last = std::min(ray(at + reach), static_cast<long>(scan_.ranges.size()) - 1);
    for (long i = std::max(ray(at - reach), 0L); i <= last; ++i) {
      float& nearest = scan_.ranges[static_cast<std::size_t>(i)];
      nearest = std::fmin(nearest, reading);  // a range wins over NaN
    }
  }
}

}  // namespace field_fusion::core
