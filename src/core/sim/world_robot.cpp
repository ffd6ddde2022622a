#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

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

// What careful hands leave, at most: of each angle, along each axis, and between clocks of one computer.
constexpr double kMountAngle = 0.2;    // [deg]
constexpr double kMountPlace = 0.005;  // [m]
constexpr double kClockError = 0.002;  // [s]

/// T_nominal_sensor, about and along the sensor's own axes.
Transform drawMountError(const Yaml& yaml, const std::string& name, const Draws& draws) {
  double angle = kMountAngle, place = kMountPlace;
  if (yaml.has("mount_error")) {
    const Yaml error = yaml["mount_error"];
    error.onlyKeys({"angle_deg", "place"});
    if (error.has("angle_deg")) angle = error["angle_deg"].number(0, 45);
    if (error.has("place")) place = error["place"].number(0, 1);
  }
  Eigen::Vector3d shift, turn;
  for (std::uint64_t i = 0; i < 3; ++i) {
    shift[static_cast<Eigen::Index>(i)] = draws.within(place, "place of " + name, i);
    turn[static_cast<Eigen::Index>(i)] = draws.within(radians(angle), "angle of " + name, i);
  }
  return frameOf(shift, turn);
}

/// It stands in topics and is a frame.
std::string mountName(const Yaml& yaml) {
  static const std::vector<std::string> taken{"base", "clock", "tf", "tf_static", "truth", "world"};
  const std::string name = yaml.text();
  const auto fits = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  if (std::isalpha(static_cast<unsigned char>(name.front())) == 0 || !std::all_of(name.begin(), name.end(), fits))
    yaml.fail("'" + name + "' must be a letter, then letters, digits and _");
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) yaml.fail("'" + name + "' is taken");
  return name;
}

Mount readMount(const Yaml& yaml, const std::string& sensors, const Draws& draws) {
  static const std::vector<std::string> own{"name", "model", "pose", "mount_error", "clock_error"};
  Mount mount;
  const auto keys = yaml.keys();
  mount.name = mountName(yaml["name"]);
  mount.model = yaml["model"].text();
  if (yaml.has("pose")) mount.T_base_nominal = readFrame(yaml["pose"]);
  mount.T_base_sensor = mount.T_base_nominal * drawMountError(yaml, mount.name, draws);
  const double clock = yaml.has("clock_error") ? yaml["clock_error"].number(0, 1) : kClockError;
  mount.clock_error = draws.within(clock, "clock of " + mount.name);
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
    sensorParams(sensors, mount.model, mount.overrides);
  } catch (const std::runtime_error& fault) {
    yaml.fail(fault.what());
  }
  return mount;
}

}  // namespace

Robot readRobot(const Yaml& yaml, const Ground& ground, const std::string& sensors, const Draws& draws) {
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
    Mount mount = readMount(item, sensors, draws);
    for (const Mount& other : robot.mounts)
      if (other.name == mount.name) item.fail("two sensors are named " + mount.name);
    robot.mounts.push_back(std::move(mount));
  }
  return robot;
}

}  // namespace field_fusion::core::sim
