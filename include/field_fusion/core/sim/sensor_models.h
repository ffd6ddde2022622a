#pragma once
// Sensors by the name of their model: the files of config/sensors/.
#include <map>
#include <string>
#include <variant>

#include "field_fusion/core/sim/depth_camera.h"
#include "field_fusion/core/sim/lidar3d.h"
#include "field_fusion/core/sim/scanner2d.h"

namespace field_fusion::core::sim {

/// As sensor files spell them in `kind`: scanner2d, lidar3d, depth_camera.
enum class SensorKind { kScanner2d, kLidar3d, kDepthCamera };

using SensorParams = std::variant<Scanner2dParams, Lidar3dParams, DepthCameraParams>;  ///< by SensorKind
using Sensor = std::variant<Scanner2d, Lidar3d, DepthCamera>;                          ///< by SensorKind

/// Parameter -> YAML text, as Mount::overrides.
using Overrides = std::map<std::string, std::string>;

/// Sets what is declared from a sensor's file, then from `overrides`. Throws std::runtime_error that names
/// file, line and key of the first fault: a parameter that is missing, unknown, there twice, of a wrong type
/// or out of its range, or a rule that is broken. The key `kind` is passed over.
void readSensorFile(const std::string& file, const Overrides& overrides, Params& declared);

/// The file of a model: FOLDER/MODEL.yaml.
std::string sensorFile(const std::string& folder, const std::string& model);

/// The parameters of a model whose kind is known. Throws as readSensorFile.
template <class P>
P readSensor(const std::string& folder, const std::string& model, const Overrides& overrides) {
  P params;
  Params declared = declarationOf(params);
  readSensorFile(sensorFile(folder, model), overrides, declared);
  return params;
}

/// What FOLDER/MODEL.yaml says it is, other kinds than SensorKind too. Throws where it says nothing.
std::string sensorKind(const std::string& folder, const std::string& model);

/// Of FOLDER/MODEL.yaml. Throws as readSensorFile, and for an unknown model or kind.
SensorParams sensorParams(const std::string& folder, const std::string& model,
                          const Overrides& overrides = {});

/// A sensor of that model; `seed` is its own (seedOf the run's and the sensor's name).
Sensor makeSensor(const std::string& folder, const std::string& model, const Overrides& overrides,
                  std::uint64_t seed);

inline SensorKind kindOf(const Sensor& sensor) { return static_cast<SensorKind>(sensor.index()); }
/// Scans or frames a second.
inline double rateOf(const Sensor& sensor) {
  return std::visit([](const auto& s) { return s.params().rate; }, sensor);
}

}  // namespace field_fusion::core::sim
