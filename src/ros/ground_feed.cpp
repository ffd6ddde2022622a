#include "field_fusion/ros/ground_feed.h"

#include <cmath>
#include <stdexcept>

namespace field_fusion {

core::Plane GroundFeed::planeFor(const std_msgs::Header& image, const TfCache& tf, double max_age,
                                 std::string& why) const try {
  const bool usable =
      plane_ && plane_->found && std::abs((plane_->header.stamp - image.stamp).toSec()) <= max_age;
  if (!usable) return {};
  const auto& n = plane_->normal;
  return carried({{n.x, n.y, n.z}, plane_->height},
                 tf.lookup(image.frame_id, plane_->header.frame_id, image.stamp));
} catch (const std::runtime_error& missing) {
  why = missing.what();
  return {};
}

core::Plane carried(const core::Plane& plane, const core::Transform& T_target_source) {
  const Eigen::Vector3d normal = T_target_source.linear() * plane.normal;
  return {normal, plane.offset - normal.dot(T_target_source.translation())};
}

}  // namespace field_fusion
