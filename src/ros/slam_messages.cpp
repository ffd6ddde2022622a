#include "field_fusion/ros/slam_messages.h"

#include <boost/make_shared.hpp>

namespace field_fusion {
namespace {

geometry_msgs::Pose poseMessage(const core::Pose2& pose) {
  geometry_msgs::Pose out;
  out.position.x = pose.x, out.position.y = pose.y;
  out.orientation.z = std::sin(0.5 * pose.yaw), out.orientation.w = std::cos(0.5 * pose.yaw);
  return out;
}

}  // namespace

boost::shared_ptr<geometry_msgs::PoseArray> particlesMessage(const std_msgs::Header& header, const core::GridSlam& slam) {
  const auto out = boost::make_shared<geometry_msgs::PoseArray>();
  out->header = header;
  for (const auto& particle : slam.particles()) out->poses.push_back(poseMessage(particle.pose));
  return out;
}

boost::shared_ptr<nav_msgs::Path> pathMessage(const std_msgs::Header& header, const core::GridSlam& slam) {
  const auto out = boost::make_shared<nav_msgs::Path>();
  out->header = header;
  for (const core::StampedPose2& node : core::pathTo(slam.best().path.get())) {
    auto& pose = out->poses.emplace_back();
    pose.header.frame_id = header.frame_id;
    pose.header.stamp.fromNSec(static_cast<std::uint64_t>(node.stamp_ns));
    pose.pose = poseMessage(node.pose);
  }
  return out;
}

}  // namespace field_fusion
