#pragma once
// The simulated office as a log: scans, drifting odometry, and the true poses.
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "slam_run.h"

namespace field_fusion::bench {

struct OfficeLog {
  std::vector<LogScan> scans;
  std::vector<core::Scan> raw;     ///< of `scans`
  std::vector<core::Pose2> truth;  ///< T_world_base of each scan
  core::Pose2 T_base_scanner;      ///< where it truly is
  core::Pose2 T_base_nominal;      ///< where its users take it to be
  double way = 0.0;                ///< [m]
};

inline core::Scan scanOf(const core::sim::Scan2d& from) {
  core::Scan out;
  out.angle_min = from.angle_min, out.angle_increment = from.angle_increment;
  out.range_min = from.range_min, out.range_max = from.range_max, out.ranges = from.ranges;
  return out;
}

/// What the office is seen with. LMS141 as it is, or `ideal`: up to 10 m alone, with a noise of 1 cm and a thin beam.
struct OfficeScanner {
  std::string view = "270", step = "0.5";  ///< [deg]
  bool ideal = false;

  core::sim::Overrides overrides() const {
    core::sim::Overrides out = {{"field_of_view", view}, {"angle_step", step}};
    if (!ideal) return out;
    for (const char* none : {"range_bias", "spot_width", "spot_height", "divergence_width", "divergence_height"})
      out[none] = "0.0";
    out["range_noise"] = "0.01", out["max_range"] = "10.0", out["min_range"] = "0.1";
    return out;
  }
};

/// Ten scans a second all round the office. Each is taken at one instant, as after `deskew_scan`.
inline OfficeLog officeLog(std::uint64_t seed, const OfficeScanner& seen_with, const core::ScanLimits& limits) {
  using namespace core::sim;
  const std::string config = PROJECT_DIR "/config/";
  const World world = loadWorld(config + "worlds/office.yaml");
  Caster caster(world);
  const auto& way = world.robot.way;
  Scanner2d scanner(std::get<Scanner2dParams>(sensorParams(config + "sensors", "lms141", seen_with.overrides())), seedOf(seed, "scan"));
  WheelOdometry wheels(std::get<WheelOdometryParams>(sensorParams(config + "sensors", "wheel_odometry")), way,
                       seedOf(seed, "odom"));
  core::Transform T_base_sensor = core::Transform::Identity(), T_nominal = T_base_sensor;
  for (const Mount& m : world.robot.mounts)
    if (m.name == "scan") T_base_sensor = m.T_base_sensor;
  T_nominal.translation() << 0.2, 0.0, 0.3;  // as the world's file says; the true mount is not known
  OfficeLog out;
  out.T_base_scanner = core::flat(T_base_sensor), out.T_base_nominal = core::flat(T_nominal);
  OdometrySample odometry = wheels.next();
  for (int k = 0; 0.1 * k < way.duration(); ++k) {
    const double time = 0.1 * k;
    while (odometry.time < time - 1e-9) odometry = wheels.next();
    const core::Transform T_world_sensor = way.pose(time) * T_base_sensor;
    const core::Scan scan = scanOf(scanner.scan(caster, [&](double) { return T_world_sensor; }, time));
    out.scans.push_back({static_cast<std::int64_t>(1e9 * time), core::slamScan(scan, T_nominal, limits), core::flat(odometry.T_odom_base)});
    out.raw.push_back(scan);
    out.truth.push_back(core::flat(way.pose(time)));
    if (k > 0) out.way += core::between(out.truth[k - 1], out.truth[k]).position().norm();
  }
  return out;
}

}  // namespace field_fusion::bench
