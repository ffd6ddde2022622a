#include "field_fusion/core/sim/sensor_models.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

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

template <class P>
SensorParams readAs(const std::string& file, const Overrides& overrides) {
  P params;
  Params declared = declarationOf(params);
  readSensorFile(file, overrides, declared);
  return params;
}

std::string fileOf(const std::string& folder, const std::string& model) {
  return (std::filesystem::path(folder) / (model + ".yaml")).string();
}

}  // namespace

const std::vector<SensorKind>& sensorKinds() {
  static const std::vector<SensorKind> kinds{
      {"scanner2d", true, false, false, readAs<Scanner2dParams>},
      {"lidar3d", true, false, false, readAs<Lidar3dParams>},
      {"depth_camera", true, true, false, readAs<DepthCameraParams>},
      {"camera", true, true, false, readAs<CameraParams>},
      {"imu", false, false, false, readAs<ImuParams>},
      {"gnss", false, false, false, readAs<GnssParams>},
      {"wheel_odometry", false, false, true, readAs<WheelOdometryParams>},
      {"leg_odometry", false, false, true, readAs<LegOdometryParams>},
  };
  return kinds;
}

const SensorKind& sensorKind(const std::string& folder, const std::string& model) {
  const std::string file = fileOf(folder, model);
  const YAML::Node root = load(file), kind = root["kind"];
  if (!kind) Source{file}.fail("kind is missing");
  const std::string name = kind.IsScalar() ? kind.Scalar() : "";
  std::string known;
  for (const SensorKind& each : sensorKinds()) {
    if (name == each.name) return each;
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  lineOf(file, kind).fail("kind '" + name + "' is none of " + known);
}

SensorParams sensorParams(const std::string& folder, const std::string& model, const Overrides& overrides) {
  return sensorKind(folder, model).read(fileOf(folder, model), overrides);
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

}  // namespace field_fusion::core::sim
