#pragma once
// A world and a seed to a stream of messages in the order of time.
#include <boost/shared_ptr.hpp>

#include <limits>
#include <string>
#include <vector>

#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {

/// The file that `world` names: a path, or a world in config/worlds/ of the package. Throws
/// std::runtime_error with the worlds that there are.
std::string worldFile(const std::string& world);
std::vector<std::string> shippedWorlds();

/// The folder of the sensors' files: `sensors` beside the world's own folder, else that of the package.
std::string sensorsBeside(const std::string& world_file);

/// Where the sensors are on the robot, as told or as true: base -> each mount but odometry, and a camera's
/// optical frame.
boost::shared_ptr<const tf2_msgs::TFMessage> mountTransforms(
    const SimSetup& setup, core::Transform core::sim::Mount::*T_base_mount);

/// The truth of a horizontal slice at the start. `height` [m] in the world.
boost::shared_ptr<const nav_msgs::OccupancyGrid> truthGrid(const core::sim::World& world, double height);

class SimRun {
 public:
  /// Throws std::runtime_error for a fault in the files of world and sensors, naming file, line and key.
  explicit SimRun(const SimParams& params);

  /// What does not change: static transforms, the world's truth. First of all.
  void begin(const SimSink& sink);
  /// [s] from the start when the next messages are ready. Without any source: infinite.
  double due() const;
  void step(const SimSink& sink);

  const core::sim::World& world() const { return world_; }

 private:
  SimParams params_;
  std::string file_;
  core::sim::World world_;
  core::sim::Caster caster_;
  SimSetup setup_;
  SimSources sources_;
};

}  // namespace field_fusion
