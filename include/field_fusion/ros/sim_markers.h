#pragma once
// A simulated world as RViz draws it. What moves is told by frames on truth/tf.
#include <geometry_msgs/TransformStamped.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "field_fusion/core/sim/world.h"

namespace field_fusion {

/// What stands still is in the frame world. The robot is in base, any other link of a body in a frame of its
/// own. RViz drops for good a mark without stamp that comes before its frame (tf2 finds stamp 0 to be older
/// than its buffer), so those that move are to be sent again and again.
enum class Marks { kStanding, kMoving };

/// Bodies, ground and robot.
boost::shared_ptr<visualization_msgs::MarkerArray> worldMarkers(const core::sim::World& world, Marks marks);

/// These frames: truth/BODY/LINK in world, and truth/robot/LINK in base, at `time` [s] of the run.
std::vector<geometry_msgs::TransformStamped> linkFrames(const core::sim::World& world, double time);

}  // namespace field_fusion
