#pragma once
// Sensors by the name of their model: the files of config/sensors/.
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "field_fusion/core/sim/camera_params.h"
#include "field_fusion/core/sim/depth_camera.h"
#include "field_fusion/core/sim/gnss.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/lidar3d.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/scanner2d.h"

namespace field_fusion::core::sim {

/// Of a sensor of any kind.
using SensorParams = std::variant<Scanner2dParams, Lidar3dParams, DepthCameraParams, CameraParams, ImuParams,
                                  GnssParams, WheelOdometryParams, LegOdometryParams>;

/// Parameter -> YAML text, as Mount::overrides.
using Overrides = std::map<std::string, std::string>;

struct SensorKind {
  const char* name;  ///< as sensor files spell it in `kind`
  bool sees;         ///< casts rays
  bool optical;      ///< makes pictures, so it has an optical frame too
  bool odometry;     ///< its frame is where the way began, not a place on the robot
  SensorParams (*read)(const std::string& file, const Overrides& overrides);  ///< throws as readSensorFile
};

/// One for each of SensorParams.
const std::vector<SensorKind>& sensorKinds();

/// What FOLDER/MODEL.yaml says it is. Throws std::runtime_error, naming file and line, where it says nothing
/// or no kind that there is.
const SensorKind& sensorKind(const std::string& folder, const std::string& model);

/// Of FOLDER/MODEL.yaml. Throws as sensorKind and readSensorFile.
SensorParams sensorParams(const std::string& folder, const std::string& model,
                          const Overrides& overrides = {});

/// Sets what is declared from a sensor's file, then from `overrides`. Throws std::runtime_error that names
/// file, line and key of the first fault: a parameter that is missing, unknown, there twice, of a wrong type
/// or out of its range, or a rule that is broken. The key `kind` is passed over.
void readSensorFile(const std::string& file, const Overrides& overrides, Params& declared);

}  // namespace field_fusion::core::sim
