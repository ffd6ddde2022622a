#pragma once
// A simulated robot as others describe robots: for robot_state_publisher, RViz and calibration tools.
#include <string>

#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

/// URDF: the link `base` with the robot's body, and fixed joints to the nominal places of its sensors, odometry
/// left out, and on to the optical frames of cameras. Boxes, cylinders and spheres are as they are, any other
/// mesh is the box about it. `sensors`: folder of the sensors' files.
std::string urdf(const World& world, const std::string& sensors);

}  // namespace field_fusion::core::sim
