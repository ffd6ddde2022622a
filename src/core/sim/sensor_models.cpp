#include "field_fusion/core/sim/sensor_models.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

const std::vector<std::string> kKinds = {"scanner2d", "lidar3d", "depth_camera"};

/// Where a value stands, for what is said about it.
struct Source {
  std::string place;  // FILE:LINE, or FILE
  [[noreturn]] void fail(const std::string& reason) const { throw std::runtime_error(place + ": " + reason); }
};

Source lineOf(const std::string& file, const YAML::Node& node) {
  return {file + ":" + std::to_string(node.Mark().line + 1)};
}

YAML::Node load(const std::string& file) {
  try {
    const YAML::Node root = YAML::LoadFile(file);
    if (!root.IsMap()) Source{file}.fail("must be a table of parameters");
    return root;
  } catch (const YAML::BadFile&) {
    Source{file}.fail("cannot be read");
  } catch (const YAML::ParserException& fault) {
    Source{file + ":" + std::to_string(fault.mark.line + 1)}.fail(fault.msg);
  }
}

void set(const Param& param, const YAML::Node& node, const Source& source) {
  Value value;
  try {
    value = std::visit([&](const auto& usual) { return Value(node.as<std::decay_t<decltype(usual)>>()); },
                       param.get());
  } catch (const YAML::Exception&) {
    source.fail(param.name + ": must be a " + param.type());
  }
  if (const std::string fault = faultOf(param, value); !fault.empty()) source.fail(fault);
  param.set(value);
}

void setFromFile(const std::string& file, const YAML::Node& root, const Params& declared) {
  std::set<std::string> seen;
  for (const auto& entry : root) {
    const Source source = lineOf(file, entry.first);
    const std::string key = entry.first.as<std::string>();
    if (!seen.insert(key).second) source.fail(key + " is there twice");
    if (key == "kind") continue;
    const Param* param = declared.find(key);
    if (!param) source.fail(key + ": unknown parameter");
    set(*param, entry.second, source);
  }
  for (const Param& param : declared.list())
    if (!seen.count(param.name)) Source{file}.fail(param.name + " is missing");
}

std::size_t kindIn(const std::string& file) {
  const YAML::Node root = load(file), kind = root["kind"];
  if (!kind) Source{file}.fail("kind is missing");
  const std::string name = kind.IsScalar() ? kind.Scalar() : "";
  const auto it = std::find(kKinds.begin(), kKinds.end(), name);
  if (it == kKinds.end())
    lineOf(file, kind).fail("kind '" + name + "' is none of scanner2d, lidar3d, depth_camera");
  return static_cast<std::size_t>(it - kKinds.begin());
}

}  // namespace

std::string sensorFile(const std::string& folder, const std::string& model) {
  return (std::filesystem::path(folder) / (model + ".yaml")).string();
}

std::string sensorKind(const std::string& folder, const std::string& model) {
  const std::string file = sensorFile(folder, model);
  const YAML::Node root = load(file), kind = root["kind"];
  if (!kind || !kind.IsScalar()) Source{file}.fail("kind is missing");
  return kind.Scalar();
}

void readSensorFile(const std::string& file, const Overrides& overrides, Params& declared) {
  setFromFile(file, load(file), declared);
  for (const auto& [key, text] : overrides) {
    const Source source{"override of " + file};
    const Param* param = declared.find(key);
    if (!param) source.fail(key + ": unknown parameter");
    set(*param, YAML::Load(text), source);
  }
  if (const auto faults = declared.faults(); !faults.empty()) Source{file}.fail(faults.front());
}

SensorParams sensorParams(const std::string& folder, const std::string& model, const Overrides& overrides) {
  switch (static_cast<SensorKind>(kindIn(sensorFile(folder, model)))) {
    case SensorKind::kScanner2d:
      return readSensor<Scanner2dParams>(folder, model, overrides);
    case SensorKind::kLidar3d:
      return readSensor<Lidar3dParams>(folder, model, overrides);
    case SensorKind::kDepthCamera:
      break;
  }
  return readSensor<DepthCameraParams>(folder, model, overrides);
}

namespace {

Sensor sensorOf(const Scanner2dParams& params, std::uint64_t seed) { return Scanner2d(params, seed); }
Sensor sensorOf(const Lidar3dParams& params, std::uint64_t seed) { return Lidar3d(params, seed); }
Sensor sensorOf(const DepthCameraParams& params, std::uint64_t seed) { return DepthCamera(params, seed); }

}  // namespace

Sensor makeSensor(const std::string& folder, const std::string& model, const Overrides& overrides,
                  std::uint64_t seed) {
  return std::visit([&](const auto& params) { return sensorOf(params, seed); },
                    sensorParams(folder, model, overrides));
}

}  // namespace field_fusion::core::sim
