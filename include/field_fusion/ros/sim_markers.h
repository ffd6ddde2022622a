#pragma once
// A simulated world as RViz draws it. Its marks are sent once; what moves is told by frames on truth/tf.
#include <geometry_msgs/TransformStamped.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "field_fusion/core/sim/world.h"

namespace field_fusion {

/// Bodies, ground and robot. What stands still is in the frame world, the robot in base, any other link of a
/// body in a frame of its own.
boost::shared_ptr<visualization_msgs::MarkerArray> worldMarkers(const core::sim::World& world);

/// These frames: truth/BODY/LINK in world, and truth/robot/LINK in base, at `time` [s] of the run.
std::vector<geometry_msgs::TransformStamped> linkFrames(const core::sim::World& world, double time);

}  // namespace field_fusion
