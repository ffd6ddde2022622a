#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "field_fusion/core/sim/camera_params.h"
#include "field_fusion/core/sim/gnss.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> modelsIn(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder, fault))
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

/// Throws what its reader throws.
void checkSensor(const std::string& folder, const Mount& mount, const std::string& kind) {
  const std::string& model = mount.model;
  const Overrides& overrides = mount.overrides;
  if (kind == "imu")
    readSensor<ImuParams>(folder, model, overrides);
  else if (kind == "gnss")
    readSensor<GnssParams>(folder, model, overrides);
  else if (kind == "wheel_odometry")
    readSensor<WheelOdometryParams>(folder, model, overrides);
  else if (kind == "leg_odometry")
    readSensor<LegOdometryParams>(folder, model, overrides);
  else if (kind == "camera")
    readSensor<CameraParams>(folder, model, overrides);
  else
    sensorParams(folder, model, overrides);
}

Mount readMount(const Yaml& yaml, const std::string& sensors) {
  static const std::vector<std::string> own{"name", "model", "pose", "clock_error"};
  Mount mount;
  const auto keys = yaml.keys();
  mount.name = yaml["name"].text();
  mount.model = yaml["model"].text();
  mount.T_base_sensor = yaml.has("pose") ? readFrame(yaml["pose"]) : Transform::Identity();
  if (yaml.has("clock_error")) mount.clock_error = yaml["clock_error"].number(0, 1);
  const auto models = modelsIn(sensors);
  if (std::find(models.begin(), models.end(), mount.model) == models.end())
    yaml["model"].fail("no sensor " + mount.model + " in " + sensors + nearestName(mount.model, models));

  const Yaml usual = Yaml::file((fs::path(sensors) / (mount.model + ".yaml")).string());
  auto parameters = usual.keys();
  parameters.erase(std::remove(parameters.begin(), parameters.end(), "kind"), parameters.end());
  for (const std::string& key : keys) {
    if (std::find(own.begin(), own.end(), key) != own.end()) continue;
    if (std::find(parameters.begin(), parameters.end(), key) == parameters.end())
      yaml[key].fail("no parameter of " + mount.model + nearestName(key, parameters));
    if (key == "rate") yaml[key].positive();
    mount.overrides[key] = yaml[key].dump();
  }
  try {
    checkSensor(sensors, mount, usual["kind"].text());
  } catch (const std::runtime_error& fault) {
    yaml.fail(fault.what());
  }
  return mount;
}

}  // namespace

Robot readRobot(const Yaml& yaml, const Ground& ground, const std::string& sensors) {
  Robot robot;
  auto keys = kWayKeys;
  keys.insert(keys.end(), {"name", "mounts", "body"});
  yaml.onlyKeys(keys);
  if (yaml.has("name")) robot.name = yaml["name"].text();
  if (yaml.has("body")) {
    yaml["body"].onlyKeys(kModelKeys);
    robot.model = readModel(yaml["body"]);
  }
  robot.way = readWay(yaml, ground, robot.model);
  if (!yaml.has("mounts")) return robot;
  for (const Yaml& item : yaml["mounts"].list()) {
    Mount mount = readMount(item, sensors);
    for (const Mount& other : robot.mounts)
      if (other.name == mount.name) item.fail("two sensors are named " + mount.name);
    robot.mounts.push_back(std::move(mount));
  }
  return robot;
}

}  // namespace field_fusion::core::sim
