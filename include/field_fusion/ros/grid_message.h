#pragma once
#include <nav_msgs/OccupancyGrid.h>

#include "field_fusion/core/map/occupancy.h"

namespace field_fusion {

boost::shared_ptr<nav_msgs::OccupancyGrid> gridMessage(const std_msgs::Header& header, const core::Occupancy& map);

}  // namespace field_fusion
