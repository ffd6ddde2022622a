#include <boost/make_shared.hpp>

#include "field_fusion/core/io/octree_file.h"
#include "field_fusion/ros/octomap_output.h"

namespace field_fusion {

boost::shared_ptr<octomap_msgs::Octomap> octomapMessage(const std_msgs::Header& header,
                                                        const core::VoxelMap& map, bool binary) {
  const auto out = boost::make_shared<octomap_msgs::Octomap>();
  out->header = header;
  out->binary = binary;
  out->id = "OcTree";
  out->resolution = map.params().resolution;
  const std::string data = core::octreeData(map, binary);
  out->data.assign(data.begin(), data.end());
  return out;
}

}  // namespace field_fusion
