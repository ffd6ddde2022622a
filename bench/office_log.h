#pragma once
// The simulated office as a log: scans, drifting odometry, and the true poses.
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "slam_run.h"

namespace field_fusion::bench {

struct OfficeLog {
  std::vector<LogScan> scans;
  std::vector<core::Pose2> truth;  ///< T_world_base of each scan
  double way = 0.0;                ///< [m]
};

inline core::Pose2 flat(const core::Transform& T) {
  return {T.translation().x(), T.translation().y(), std::atan2(T.linear()(1, 0), T.linear()(0, 0))};
}

/// Ten scans a second, up to 10 m with a noise of 1 cm, of a scanner with `field_of_view` and `angle_step` [deg], all round the office. Each is
/// taken at one instant, as after `deskew_scan`.
inline OfficeLog officeLog(std::uint64_t seed, const std::string& field_of_view, const std::string& angle_step,
                           const core::ScanLimits& limits) {
  using namespace core::sim;
  const std::string config = PROJECT_DIR "/config/";
  const World world = loadWorld(config + "worlds/office.yaml");
  Caster caster(world);
  const auto& way = world.robot.way;
  const Overrides ideal = {{"field_of_view", field_of_view}, {"angle_step", angle_step}, {"range_bias", "0.0"},
                           {"range_noise", "0.01"}, {"spot_width", "0.0"}, {"spot_height", "0.0"},
                           {"divergence_width", "0.0"}, {"divergence_height", "0.0"}, {"max_range", "10.0"},
                           {"min_range", "0.1"}};
  Scanner2d scanner(std::get<Scanner2dParams>(sensorParams(config + "sensors", "lms141", ideal)), seedOf(seed, "scan"));
  WheelOdometry wheels(std::get<WheelOdometryParams>(sensorParams(config + "sensors", "wheel_odometry")), way,
                       seedOf(seed, "odom"));
  core::Transform T_base_sensor = core::Transform::Identity();
  for (const Mount& m : world.robot.mounts)
    if (m.name == "scan") T_base_sensor = m.T_base_sensor;
  OfficeLog out;
  OdometrySample odometry = wheels.next();
  for (int k = 0; 0.1 * k < way.duration(); ++k) {
    const double time = 0.1 * k;
    while (odometry.time < time - 1e-9) odometry = wheels.next();
    const core::Transform T_world_sensor = way.pose(time) * T_base_sensor;
    const Scan2d& scan = scanner.scan(caster, [&](double) { return T_world_sensor; }, time);
    core::Transform T_nominal = core::Transform::Identity();
    T_nominal.translation() << 0.2, 0.0, 0.3;  // as the world's file says; the true mount is not known
    out.scans.push_back({static_cast<std::int64_t>(1e9 * time),
                         core::slamScan(scan.ranges, scan.angle_min, scan.angle_increment, T_nominal, limits),
                         flat(odometry.T_odom_base)});
    out.truth.push_back(flat(way.pose(time)));
    if (k > 0) out.way += core::between(out.truth[k - 1], out.truth[k]).position().norm();
  }
  return out;
}

}  // namespace field_fusion::bench
