#pragma once
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include "field_fusion/core/map/voxel_map.h"

namespace field_fusion {

/// The occupied voxels from min_height of the map on, as one list of cubes: coloured by height from blue
/// there to red at max_height, grey above. The floor would hide what stands on it.
boost::shared_ptr<visualization_msgs::MarkerArray> voxelMarkers(const std_msgs::Header& header,
                                                                const core::VoxelMap& map);

}  // namespace field_fusion
