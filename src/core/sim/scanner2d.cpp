#include "field_fusion/core/sim/scanner2d.h"

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

double signedStep(const Scanner2dParams& params) {
  return radians(params.clockwise ? -params.angle_step : params.angle_step);
}

double firstAngle(const Scanner2dParams& params) { return -0.5 * params.steps() * signedStep(params); }

double beamTime(const Scanner2dParams& params) {
  return params.at_once ? 0.0 : params.angle_step / 360.0 / params.rate;
}

BeamGrid gridOf(const Scanner2dParams& params) {
  BeamGrid grid;
  const bool closed = params.field_of_view == 360.0;  // the last beam is not the first again
  grid.columns = params.steps() + (closed ? 0 : 1);
  grid.step = static_cast<float>(radians(params.angle_step));
  for (int i = 0; i < grid.columns; ++i) {
    const double angle = firstAngle(params) + i * signedStep(params);
    grid.directions.push_back(Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>());
    grid.times.push_back(static_cast<float>(i * beamTime(params)));
  }
  return grid;
}

}  // namespace

Scanner2d::Scanner2d(const Scanner2dParams& params, std::uint64_t seed)
    : params_(checked(params)), beams_(params.beam, gridOf(params), seed) {
  const int beams = beams_.grid().columns;
  scan_.angle_min = static_cast<float>(firstAngle(params));
  scan_.angle_increment = static_cast<float>(signedStep(params));
  scan_.angle_max = static_cast<float>(firstAngle(params) + (beams - 1) * signedStep(params));
  scan_.time_increment = static_cast<float>(beamTime(params));
  scan_.scan_time = static_cast<float>(1.0 / params.rate);
  scan_.range_min = static_cast<float>(params.beam.min_range);
  scan_.range_max = static_cast<float>(params.beam.max_range);
  scan_.ranges.resize(static_cast<std::size_t>(beams));
  scan_.intensities.resize(static_cast<std::size_t>(beams));
}

const Scan2d& Scanner2d::scan(Caster& caster, const PoseAt& T_world_sensor, double stamp) {
  const auto& returns = beams_.run(caster, T_world_sensor, stamp);
  scan_.stamp = stamp;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    scan_.ranges[i] = returns[i].range;
    scan_.intensities[i] = returns[i].intensity;
  }
  return scan_;
}

}  // namespace field_fusion::core::sim
