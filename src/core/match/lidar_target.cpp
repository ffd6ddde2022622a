#include "field_fusion/core/match/lidar_target.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

/// The three edges of the box as columns.
Eigen::Matrix3d edgesOf(const Cluster& cluster) {
  const OrientedBox& box = cluster.oriented_box;
  const Eigen::Vector3d size = (std::isfinite(box.yaw) ? box.size : cluster.box.sizes()).cast<double>();
  const double yaw = std::isfinite(box.yaw) ? double(box.yaw) : 0.0;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * size.asDiagonal();
}

}  // namespace

void describeMembers(LidarTarget& body, const std::vector<Point>& points, OrientedBoxFitter* fitter) {
  std::vector<Point> gathered;
  gathered.reserve(body.members.size());
  float nearest2 = std::numeric_limits<float>::infinity();
  for (const std::uint32_t i : body.members) {
    gathered.push_back(points[i]);
    nearest2 = std::min(nearest2, points[i].position().squaredNorm());
  }
  body.cluster = {};
  body.cluster.nearest_range = std::sqrt(nearest2);
  describe(body.cluster, gathered.data(), gathered.size(), fitter);
}

Sight sightOf(const Cluster& cluster, const Transform& T_view_lidar) {
  constexpr double kNear = 0.01;  // [m] has no direction any more
  Sight out;
  const Eigen::Vector3d centre = T_view_lidar * cluster.centre.cast<double>();
  if (!centre.allFinite() || centre.norm() < kNear) return out;
  out.centre = polar(centre);
  const Eigen::Vector3d along = centre.normalized();
  const Eigen::Vector3d left(-std::sin(out.centre.azimuth), std::cos(out.centre.azimuth), 0.0);
  const Eigen::Vector3d up = along.cross(left);
  const Eigen::Matrix3d edges = T_view_lidar.linear() * edgesOf(cluster);
  const auto extent = [&](const Eigen::Vector3d& axis) {
    return (axis.transpose() * edges).cwiseAbs().sum();
  };
  out.depth = extent(along);
  out.width = 2.0 * std::atan2(0.5 * extent(left), out.centre.range);
  out.height = 2.0 * std::atan2(0.5 * extent(up), out.centre.range);
  return out;
}

}  // namespace field_fusion::core
