#include "field_fusion/core/match/obstacle_points.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

Point pointAt(const Eigen::Vector3d& position) {
  Point out;
  out.x = static_cast<float>(position.x());
  out.y = static_cast<float>(position.y());
  out.z = static_cast<float>(position.z());
  return out;
}

/// A body never reaches beyond the origin: the robot stands there.
void appendArc(const Eigen::Vector3d& centre, double wanted_radius, double spacing, Cloud& out) {
  const double radius = std::min(wanted_radius, centre.head<2>().norm());
  const double half_circle = radians(180.0);
  const double towards_origin = std::atan2(-centre.y(), -centre.x());
  const int steps = static_cast<int>(std::ceil(half_circle * radius / spacing));
  for (int i = 0; i <= steps; ++i) {
    const double angle = towards_origin + (steps == 0 ? 0.0 : half_circle * (double(i) / steps - 0.5));
    out.push_back(pointAt(centre + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)));
  }
}

}  // namespace

void appendLidarPoints(const std::vector<ObstacleBody>& bodies, const Cloud& points,
                       const Transform& T_out_lidar, const ObstaclePointsParams& params, Cloud& out) {
  for (const auto& body : bodies) {
    if (!(body.existence >= params.min_existence)) continue;
    for (std::uint32_t i = 0; i < body.points.count; ++i) {
      const Eigen::Vector3d p = T_out_lidar * points[body.points.first + i].position().cast<double>();
      if (p.allFinite() && p.z() >= params.min_height && p.z() <= params.max_height)
        out.push_back(pointAt(p));
    }
  }
}

void appendCameraPoints(const std::vector<ObstacleBody>& bodies, double spacing, const Transform& T_out_lidar,
                        const ObstaclePointsParams& params, Cloud& out) {
  if (!params.camera_alone) return;
  for (const auto& body : bodies) {
    if (body.points.count > 0 || !(body.existence >= params.min_existence)) continue;
    Eigen::Vector3d centre = T_out_lidar * body.position;
    if (!centre.allFinite()) continue;
    centre.z() = std::clamp(centre.z(), params.min_height, params.max_height);
    appendArc(centre, std::isnan(body.radius) ? params.camera_radius : body.radius, spacing, out);
  }
}

}  // namespace field_fusion::core
