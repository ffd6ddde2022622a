#include "field_fusion/core/sim/seen.h"

#include <cmath>

namespace field_fusion::core::sim {

std::vector<Ray> raysOf(const DepthCameraParams& camera, const PoseTrack::Pose& pose, int step) {
  std::vector<Ray> rays;
  const double focal = camera.focal_length;
  for (int row = 0; row < camera.height; row += step)
    for (int column = 0; column < camera.width; column += step) {
      const Eigen::Vector3d ahead(1.0, (0.5 * (camera.width - 1) - column) / focal,
                                  (0.5 * (camera.height - 1) - row) / focal);
      rays.push_back({pose.position, pose.rotation * ahead.cast<float>().normalized(), 0.f});
    }
  return rays;
}

std::vector<Ray> raysOf(const Scanner2dParams& scanner, const PoseTrack::Pose& pose) {
  std::vector<Ray> rays;
  for (int i = 0; i <= scanner.steps(); ++i) {
    const double angle = radians(i * scanner.angle_step - 0.5 * scanner.field_of_view);
    const Eigen::Vector3d ahead(std::cos(angle), std::sin(angle), 0.0);
    rays.push_back({pose.position, pose.rotation * ahead.cast<float>(), 0.f});
  }
  return rays;
}

void addSeen(const Caster& caster, const std::vector<Ray>& rays, const SeenParams& params, double cell,
             SeenCells& cells) {
  std::vector<Hit> hits(rays.size());
  caster.cast(rays.data(), hits.data(), rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].body < 0 || hits[i].range < params.nearest || hits[i].range > params.farthest) continue;
    const Eigen::Vector3d place =
        rays[i].origin.cast<double>() + hits[i].range * rays[i].direction.cast<double>();
    if (place.z() < params.low || place.z() > params.high) continue;
    cells.emplace(static_cast<int>(std::floor(place.x() / cell)), static_cast<int>(std::floor(place.y() / cell)));
  }
}

SeenCells outlineOf(const TruthGrid& slice) {
  SeenCells out;
  const auto empty = [&](int column, int row) {
    return column < 0 || row < 0 || column >= slice.columns || row >= slice.rows || !slice.at(column, row);
  };
  const int west = static_cast<int>(std::lround(slice.origin.x() / slice.cell));
  const int south = static_cast<int>(std::lround(slice.origin.y() / slice.cell));
  for (int row = 0; row < slice.rows; ++row)
    for (int column = 0; column < slice.columns; ++column)
      if (slice.at(column, row) && (empty(column - 1, row) || empty(column + 1, row) || empty(column, row - 1) ||
                                    empty(column, row + 1)))
        out.emplace(west + column, south + row);
  return out;
}

}  // namespace field_fusion::core::sim
