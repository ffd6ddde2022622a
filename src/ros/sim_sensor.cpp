#include "field_fusion/ros/sim_sensor.h"

#include <map>
#include <stdexcept>

#include "field_fusion/core/sim/beam_random.h"

namespace field_fusion {

namespace sim = core::sim;

std::uint64_t SimSetup::seedOf(const std::string& what) const {
  return sim::seedOf(static_cast<std::uint64_t>(params.seed), what);
}

SimMount::SimMount(const SimSetup& setup, const sim::Mount& mount) : name_(mount.name) {
  pose_ = [&way = setup.world.robot.way, T = mount.T_base_sensor](double time) { return way.pose(time) * T; };
  sim::BeamRandom random(setup.seedOf(mount.name + " clock"), 0);
  clock_error_ = mount.clock_error * (2.0 * static_cast<double>(random.uniform()) - 1.0);
}

std_msgs::Header SimMount::header(double time, const char* frame_suffix) const {
  std_msgs::Header header;
  header.stamp = simTime(time + clock_error_);
  header.frame_id = name_ + frame_suffix;
  return header;
}

bool isOdometry(const SimSetup& setup, const sim::Mount& mount) {
  const std::string kind = sim::sensorKind(setup.sensors, mount.model);
  return kind == "wheel_odometry" || kind == "leg_odometry";
}

bool isCamera(const SimSetup& setup, const sim::Mount& mount) {
  const std::string kind = sim::sensorKind(setup.sensors, mount.model);
  return kind == "depth_camera" || kind == "camera";
}

std::unique_ptr<SimSource> simSource(const SimSetup& setup, const sim::Mount& mount, bool odometry_tf) {
  const std::string kind = sim::sensorKind(setup.sensors, mount.model);
  if (kind == "wheel_odometry") return simWheelOdometry(setup, mount, odometry_tf);
  if (kind == "leg_odometry") return simLegOdometry(setup, mount, odometry_tf);
  using Maker = std::unique_ptr<SimSource> (*)(const SimSetup&, const sim::Mount&);
  static const std::map<std::string, Maker> makers{
      {"scanner2d", simScanner2d}, {"lidar3d", simLidar3d}, {"depth_camera", simDepthCamera},
      {"camera", simColourCamera}, {"imu", simImu},         {"gnss", simGnss}};
  const auto maker = makers.find(kind);
  if (maker == makers.end())
    throw std::runtime_error("sensor " + mount.name + ": " + mount.model + " is of the unknown kind " + kind);
  return maker->second(setup, mount);
}

}  // namespace field_fusion
