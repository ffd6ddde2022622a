#include "field_fusion/ros/convert_ground.h"

#include <boost/make_shared.hpp>

namespace field_fusion {

boost::shared_ptr<GroundPlane> groundMessage(const std_msgs::Header& header, const core::Ground& ground) {
  auto out = boost::make_shared<GroundPlane>();
  out->header = header;
  out->found = ground.found();
  out->normal.x = ground.plane.normal.x();
  out->normal.y = ground.plane.normal.y();
  out->normal.z = ground.plane.normal.z();
  out->height = ground.plane.offset;
  out->tilt = ground.tilt;
  out->inliers = static_cast<std::uint32_t>(ground.inliers);
  out->confidence = ground.confidence;
  out->fault = describe(ground.fault);
  return out;
}

}  // namespace field_fusion
