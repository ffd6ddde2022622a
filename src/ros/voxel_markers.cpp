#include "field_fusion/ros/voxel_markers.h"

#include <algorithm>
#include <boost/make_shared.hpp>

#include "field_fusion/ros/marker_shapes.h"

namespace field_fusion {
namespace {

std_msgs::ColorRGBA colour(float red, float green, float blue) {
  std_msgs::ColorRGBA out;
  out.r = red, out.g = green, out.b = blue, out.a = 1.f;
  return out;
}

/// From blue (0) by green (0.5) to red (1); grey above.
std_msgs::ColorRGBA colourOf(double share) {
  if (share > 1.0) return colour(0.5f, 0.5f, 0.5f);
  const auto ramp = [share](double middle) {
    return static_cast<float>(std::clamp(1.5 - std::abs(4.0 * share - middle), 0.0, 1.0));
  };
  return colour(ramp(3.0), ramp(2.0), ramp(1.0));
}

}  // namespace

boost::shared_ptr<visualization_msgs::MarkerArray> voxelMarkers(const std_msgs::Header& header,
                                                                const core::VoxelMap& map) {
  const auto out = boost::make_shared<visualization_msgs::MarkerArray>();
  auto& marker = out->markers.emplace_back();
  marker.header = header, marker.ns = "voxels";
  marker.type = visualization_msgs::Marker::CUBE_LIST;
  marker.pose.orientation.w = 1.0;
  const auto& p = map.params();
  marker.scale.x = marker.scale.y = marker.scale.z = p.resolution;
  marker.color = colour(0.5f, 0.5f, 0.5f);
  map.store().forEach([&](const core::CubeKey& place, const core::VoxelCube& cube) {
    core::forEachBit(cube.known, [&](int i) {
      if (!map.isOccupied(cube.log_odds[i])) return;
      const Eigen::Vector3d centre = map.lattice().centre(core::voxelOf(place, i));
      if (centre.z() < p.min_height) return;
      marker.points.push_back(pointOf(centre));
      marker.colors.push_back(colourOf((centre.z() - p.min_height) / (p.max_height - p.min_height)));
    });
  });
  return out;
}

}  // namespace field_fusion
