#include <algorithm>
#include <filesystem>

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

/// A parameter of the sensor, of the same kind as its default.
void checkOverride(const Yaml& value, const Yaml& usual, const std::string& key) {
  if (usual.isMap() != value.isMap() || usual.isList() != value.isList())
    value.fail(std::string("must be a ") + (usual.isMap()    ? "table"
                                            : usual.isList() ? "list"
                                                             : "single value"));
  if (!usual.isText()) return;
  const auto isNumber = [](const Yaml& yaml) {
    double number;
    return YAML::convert<double>::decode(YAML::Load(yaml.dump()), number);
  };
  if (isNumber(usual) && !isNumber(value)) value.fail("must be a number");
  if (key == "rate") value.positive();
}

Mount readMount(const Yaml& yaml, const std::string& sensors) {
  static const std::vector<std::string> own{"name", "model", "pose"};
  Mount mount;
  const auto keys = yaml.keys();
  mount.name = yaml["name"].text();
  mount.model = yaml["model"].text();
  mount.T_base_sensor = yaml.has("pose") ? readFrame(yaml["pose"]) : Transform::Identity();
  const auto models = modelsIn(sensors);
  if (std::find(models.begin(), models.end(), mount.model) == models.end())
    yaml["model"].fail("no sensor " + mount.model + " in " + sensors + nearestName(mount.model, models));

  const Yaml usual = Yaml::file((fs::path(sensors) / (mount.model + ".yaml")).string());
  const auto parameters = usual.keys();
  for (const std::string& key : keys) {
    if (std::find(own.begin(), own.end(), key) != own.end()) continue;
    if (!usual.has(key)) yaml[key].fail("no parameter of " + mount.model + nearestName(key, parameters));
    checkOverride(yaml[key], usual[key], key);
    mount.overrides[key] = yaml[key].dump();
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
