#pragma once
// A world: bodies, ground, light, and the robot with its sensors. World frame: x east, y north, z up.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "field_fusion/core/sim/model.h"
#include "field_fusion/core/sim/trajectory.h"

namespace field_fusion::core::sim {

constexpr double kGravity = 9.80665;  ///< [m/s^2]

struct Body {
  std::string name;   ///< unique in the world
  std::string label;  ///< class; empty: part of the surroundings, such as a wall
  Model model;
  Trajectory way;                                  ///< T_world_body
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] true extent along the body's x, y, z
};

struct Wave {
  double amplitude = 0.1;  ///< [m]
  double length = 8.0;     ///< [m] from crest to crest; the speed follows from deep water
  double heading = 0.0;    ///< [rad] that it runs towards
  double phase = 0.0;      ///< [rad]
};

struct Ground {
  enum class Kind { kNone, kPlane, kRough, kWater };

  Kind kind = Kind::kPlane;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< [m/m] rise along x and y
  double roughness = 0.0;                           ///< [m] standard deviation of the height, for kRough
  double grain = 2.0;                               ///< [m] extent of its bumps
  double half_extent = 100.0;                       ///< [m] of a rough ground about the origin
  unsigned seed = 1;
  std::vector<Wave> waves;  ///< for kWater
  Material material;

  double height(double x, double y, double time) const;  ///< [m]; NaN for kNone
};

struct Light {
  Eigen::Vector3d to_sun{0.4, 0.3, 0.87};  ///< unit vector
  double sun = 1.0, sky = 0.35;            ///< brightness of direct and of diffuse light
  // Colours of the light, linear RGB; only their ratios count.
  Eigen::Vector3f sun_colour{1.06f, 1.f, 0.86f};
  Eigen::Vector3f zenith{0.16f, 0.34f, 0.74f}, horizon{0.72f, 0.84f, 0.98f};  ///< also to each other
  double clouds = 0.5;                                                        ///< 0..1: none .. overcast
  double cloud_size = 1.0;                                                    ///< over that of fair weather
  unsigned cloud_seed = 0;
  double visibility = 6000.0;  ///< [m] in which haze takes 1 - 1/e
};

/// A sensor on the robot. Its kind's parameters are in config/sensors/MODEL.yaml, changed by `overrides`.
struct Mount {
  std::string name;                                  ///< unique on the robot; names topics and frame
  std::string model;                                 ///< such as rplidar_a3
  Transform T_base_nominal = Transform::Identity();  ///< as TF and URDF tell it, x forward; cameras too
  Transform T_base_sensor = Transform::Identity();   ///< as it truly is
  double clock_error = 0.0;                          ///< [s] by which its clock is ahead
  std::map<std::string, std::string> overrides;      ///< parameter -> YAML text
};

struct Robot {
  std::string name = "robot";
  Trajectory way;  ///< T_world_base
  std::vector<Mount> mounts;
  Model model;  ///< its own body, which its sensors see too
};

/// A length of the world that maps are measured by.
struct Dimension {
  std::string name;
  Eigen::Vector3d from, to;  ///< [m] world

  double length() const { return (to - from).norm(); }
};

struct World {
  std::string name;
  std::vector<Body> bodies;
  Ground ground;
  Light light;
  Robot robot;
  std::vector<Dimension> dimensions;
};

/// The format: docs/worlds.md. Sensor models are the files of `sensors`, by default the folder of that name
/// beside the world's own folder. What a user of the robot does not know (mounts, clocks, sizes of bodies) is
/// drawn from `seed`; without one it is as the file says. Throws std::runtime_error naming file, line and key
/// of the first fault.
World loadWorld(const std::string& file, const std::string& sensors = "",
                std::optional<std::uint64_t> seed = {});

}  // namespace field_fusion::core::sim
