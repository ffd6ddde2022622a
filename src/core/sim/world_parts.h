#pragma once
// The parts that loadWorld reads a file by.
#include <optional>

#include "draws.h"
#include "field_fusion/core/sim/ride.h"
#include "yaml_reader.h"

namespace field_fusion::core::sim {

/// Turned by roll, then pitch, then yaw [rad] about fixed axes, then put to `place` [m].
Transform frameOf(const Eigen::Vector3d& place, const Eigen::Vector3d& roll_pitch_yaw);
/// A list of x, y, z and perhaps roll_deg, pitch_deg, yaw_deg.
Transform readFrame(const Yaml& yaml);
void readMaterial(const Yaml& yaml, Material& material);
/// By the keys material and materials of a body or a part.
void paint(const Yaml& yaml, Model& model);
/// From the keys of kModelKeys.
Model readModel(const Yaml& yaml);
inline const std::vector<std::string> kModelKeys{"shape",    "params",    "mesh", "scale",
                                                 "material", "materials", "parts"};

/// From the keys of kWayKeys, `offset` [m] along x and y from where they say, put on the ground.
Trajectory readWay(const Yaml& yaml, const Ground& ground, const Model& model,
                   const Eigen::Vector2d& offset = {0, 0});
inline const std::vector<std::string> kWayKeys{"pose", "motion", "floats", "leans"};

constexpr double kMostSpread = 0.5;  ///< of sizes: a body of size 0 is none

/// `repeat` makes several. `size_spread` is that of labelled bodies without one of their own.
std::vector<Body> readBodies(const Yaml& yaml, const Ground& ground, double size_spread, const Draws& draws);
Robot readRobot(const Yaml& yaml, const Ground& ground, const std::string& sensors, const Draws& draws);

/// Whether a point [m] in the body's frame lies inside one of its closed parts, at their joints' `time`.
bool inside(const Model& model, const Eigen::Vector3d& point, double time);

/// A place of the robot that is inside a body.
struct Touch {
  std::size_t place;
  const Body* body;
  double time;  ///< [s] since the start
};
/// The first of `places` [m, base frame] that meets a body on the robot's way or its first lap, looked at every 0.05 s or
/// at 2000 places of a longer one.
std::optional<Touch> firstTouch(const World& world, const std::vector<Eigen::Vector3d>& places);

/// The same model elsewhere in its body's frame.
Model moved(Model model, const Transform& T_body_model);

/// `factor` times as large in all directions, seen from the point `foot` [m] above the origin. Joints swing
/// the slower the larger it is: its feet then tread as fast as before.
Model scaled(Model model, double factor, double foot);

}  // namespace field_fusion::core::sim
