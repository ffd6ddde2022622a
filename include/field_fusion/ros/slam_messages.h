#pragma once
// Messages of the grid SLAM.
#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/Path.h>

#include "field_fusion/core/map/grid_slam.h"

namespace field_fusion {

boost::shared_ptr<geometry_msgs::PoseArray> particlesMessage(const std_msgs::Header& header, const core::GridSlam& slam);
/// Of the best particle, each pose with the stamp of its scan.
boost::shared_ptr<nav_msgs::Path> pathMessage(const std_msgs::Header& header, const core::GridSlam& slam);

}  // namespace field_fusion
