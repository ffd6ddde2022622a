#include "field_fusion/core/sim/lidar3d.h"

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

/// The head turns on while the lasers of a column fire one after another.
BeamGrid gridOf(const Lidar3dParams& params) {
  BeamGrid grid;
  grid.rows = static_cast<int>(params.elevations.size());
  grid.columns = params.columns();
  const double turn_rate = radians(360.0) * params.rate;
  grid.step = static_cast<float>(turn_rate * 1e-6 * params.column_time);
  for (std::size_t ring = 0; ring < params.elevations.size(); ++ring)
    for (int column = 0; column < grid.columns; ++column) {
      const double time = 1e-6 * params.column_time * column + params.fireTime(ring);
      const double azimuth =
          radians(params.first_azimuth) + (params.clockwise ? -turn_rate : turn_rate) * time;
      grid.directions.push_back(cartesian({1.0, azimuth, radians(params.elevations[ring])}).cast<float>());
      grid.times.push_back(static_cast<float>(time));
    }
  return grid;
}

}  // namespace

Lidar3d::Lidar3d(const Lidar3dParams& params, std::uint64_t seed)
    : params_(checked(params)), beams_(params.beam, gridOf(params), seed) {}

const Cloud& Lidar3d::scan(Caster& caster, const PoseAt& T_world_sensor, double stamp) {
  const auto& returns = beams_.run(caster, T_world_sensor, stamp);
  const BeamGrid& grid = beams_.grid();
  cloud_.clear(), truth_.clear();
  for (int column = 0; column < grid.columns; ++column)
    for (int row = 0; row < grid.rows; ++row) {
      const std::size_t beam = static_cast<std::size_t>(row) * grid.columns + column;
      const BeamReturn& seen = returns[beam];
      if (!std::isfinite(seen.range)) continue;
      const Eigen::Vector3f p = seen.range * grid.directions[beam];
      cloud_.push_back(
          {p.x(), p.y(), p.z(), seen.intensity, grid.times[beam], static_cast<std::uint16_t>(row)});
      truth_.push_back(seen);
    }
  return cloud_;
}

}  // namespace field_fusion::core::sim
