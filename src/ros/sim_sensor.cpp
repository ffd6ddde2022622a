#include "field_fusion/ros/sim_sensor.h"

#include "field_fusion/core/sim/beam_random.h"

namespace field_fusion {

namespace sim = core::sim;

std::uint64_t SimSetup::seedOf(const std::string& what) const {
  return sim::seedOf(static_cast<std::uint64_t>(params.seed), what);
}

const sim::SensorKind& SimSetup::kindOf(const sim::Mount& mount) const {
  return sim::sensorKind(sensors, mount.model);
}

SimMount::SimMount(const SimSetup& setup, const sim::Mount& mount)
    : name_(mount.name), clock_error_(mount.clock_error) {
  pose_ = [&way = setup.world.robot.way, T = mount.T_base_sensor](double time) { return way.pose(time) * T; };
}

std_msgs::Header SimMount::header(double time, const char* frame_suffix) const {
  std_msgs::Header header;
  header.stamp = simTime(time + clock_error_);
  header.frame_id = name_ + frame_suffix;
  return header;
}

std::unique_ptr<SimSource> simSource(const SimSetup& setup, const sim::Mount& mount) {
  return std::visit([&](const auto& params) { return simSensor(setup, mount, params); },
                    sim::sensorParams(setup.sensors, mount.model, mount.overrides));
}

}  // namespace field_fusion
