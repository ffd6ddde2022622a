#include "field_fusion/ros/sim_run.h"

#include <ros/package.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "field_fusion/core/sim/lens.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_markers.h"

namespace field_fusion {

namespace fs = std::filesystem;
namespace sim = core::sim;

namespace {

fs::path worldsFolder() { return fs::path(ros::package::getPath("field_fusion")) / "config" / "worlds"; }

/// The world with the sensors that take part alone.
sim::World loaded(const std::string& file, const SimParams& params) {
  sim::World world =
      sim::loadWorld(file, sensorsBeside(file), static_cast<std::uint64_t>(params.seed));
  auto& mounts = world.robot.mounts;
  for (const std::string& name : params.mounts)
    if (std::none_of(mounts.begin(), mounts.end(), [&](const auto& mount) { return mount.name == name; }))
      throw std::runtime_error(file + ": the robot has no sensor " + name);
  const auto idle = [&](const sim::Mount& mount) {
    return std::find(params.mounts.begin(), params.mounts.end(), mount.name) == params.mounts.end();
  };
  if (!params.mounts.empty()) mounts.erase(std::remove_if(mounts.begin(), mounts.end(), idle), mounts.end());
  return world;
}

double sliceHeight(const SimSetup& setup) {
  if (setup.params.grid_height >= 0.0) return setup.params.grid_height;
  const core::Transform T_world_base = setup.world.robot.way.pose(0.0);
  for (const sim::Mount& mount : setup.world.robot.mounts)
    if (std::string(setup.kindOf(mount).name) == "scanner2d")
      return (T_world_base * mount.T_base_sensor).translation().z();
  return T_world_base.translation().z() + 0.3;
}

}  // namespace

std::vector<std::string> shippedWorlds() {
  std::vector<std::string> names;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(worldsFolder(), fault))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string worldFile(const std::string& world) {
  if (fs::is_regular_file(world)) return world;
  const fs::path shipped = worldsFolder() / (world + ".yaml");
  if (fs::is_regular_file(shipped)) return shipped.string();
  std::string known;
  for (const std::string& name : shippedWorlds()) known += (known.empty() ? "" : ", ") + name;
  throw std::runtime_error("no world " + world + ": neither a file nor one of " + known);
}

std::string sensorsBeside(const std::string& world_file) {
  const fs::path own = (fs::path(world_file).parent_path() / ".." / "sensors").lexically_normal();
  return (fs::is_directory(own) ? own : worldsFolder().parent_path() / "sensors").string();
}

boost::shared_ptr<const tf2_msgs::TFMessage> mountTransforms(const SimSetup& setup,
                                                            core::Transform sim::Mount::*T_base_mount) {
  auto message = boost::make_shared<tf2_msgs::TFMessage>();
  for (const sim::Mount& mount : setup.world.robot.mounts) {
    const sim::SensorKind& kind = setup.kindOf(mount);
    if (kind.odometry) continue;
    message->transforms.push_back(transformMessage(simTime(0.0), "base", mount.name, mount.*T_base_mount));
    if (kind.optical)
      message->transforms.push_back(
          transformMessage(simTime(0.0), mount.name, mount.name + "_optical", sim::sensorToOptical()));
  }
  return message;
}

SimRun::SimRun(const SimParams& params)
    : params_(params),
      file_(worldFile(params.world)),
      world_(loaded(file_, params)),
      caster_(world_),
      setup_{world_, caster_, params_, sensorsBeside(file_), ""} {
  for (const sim::Mount& mount : world_.robot.mounts) {
    if (setup_.tf_odometry.empty() && setup_.kindOf(mount).odometry) setup_.tf_odometry = mount.name;
    sources_.push_back(simSource(setup_, mount));
  }
  if (sources_.empty()) throw std::runtime_error(file_ + ": the robot has no sensors");
  if (!params.truth) return;
  for (auto& source : simTruth(setup_)) sources_.push_back(std::move(source));
}

void SimRun::begin(const SimSink& sink) {
  const auto told = mountTransforms(setup_, &sim::Mount::T_base_nominal);
  if (params_.static_tf && !told->transforms.empty()) sink({"/tf_static", simTime(0.0), told, true});
  if (!params_.truth) return;
  sink({"truth/tf_static", simTime(0.0), mountTransforms(setup_, &sim::Mount::T_base_sensor), true});
  sink({"truth/grid", simTime(0.0), truthGrid(world_, sliceHeight(setup_)), true});
  boost::shared_ptr<const visualization_msgs::MarkerArray> markers =
      worldMarkers(world_, Marks::kStanding);
  sink({"truth/markers", simTime(0.0), markers, true});
}

double SimRun::due() const {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& source : sources_) first = std::min(first, source->due());
  return first;
}

void SimRun::step(const SimSink& sink) {
  const auto first = std::min_element(sources_.begin(), sources_.end(),
                                      [](const auto& a, const auto& b) { return a->due() < b->due(); });
  if (first != sources_.end()) (*first)->run(sink);
}

}  // namespace field_fusion
