#include "field_fusion/ros/grid_message.h"

#include <boost/make_shared.hpp>

namespace field_fusion {

boost::shared_ptr<nav_msgs::OccupancyGrid> gridMessage(const std_msgs::Header& header, const core::Occupancy& map) {
  const auto out = boost::make_shared<nav_msgs::OccupancyGrid>();
  out->header = header;
  out->info.map_load_time = header.stamp;
  out->info.resolution = static_cast<float>(map.resolution);
  out->info.width = static_cast<std::uint32_t>(map.width), out->info.height = static_cast<std::uint32_t>(map.height);
  out->info.origin.position.x = map.x, out->info.origin.position.y = map.y;
  out->info.origin.orientation.w = 1.0;
  out->data = map.cells;
  return out;
}

}  // namespace field_fusion
