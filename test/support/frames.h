#pragma once
// Transforms that a test sends and asks for.
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "field_fusion/ros/recording.h"

namespace field_fusion::test {

class Frames {
 public:
  void sendStatic(const std::string& parent, const std::string& child,
                  const core::Transform& T_parent_child) {
    static_.sendTransform(transformMessage(ros::Time(1.0), parent, child, T_parent_child));
  }
  void send(double stamp, const std::string& parent, const std::string& child,
            const core::Transform& T_parent_child) {
    moving_.sendTransform(transformMessage(ros::Time(stamp), parent, child, T_parent_child));
  }
  bool knows(double stamp, const std::string& target, const std::string& source) const {
    return buffer_.canTransform(target, source, ros::Time(stamp));
  }
  core::Transform at(double stamp, const std::string& target, const std::string& source) const {
    return tf2::transformToEigen(buffer_.lookupTransform(target, source, ros::Time(stamp)));
  }

 private:
  tf2_ros::StaticTransformBroadcaster static_;
  tf2_ros::TransformBroadcaster moving_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
};

}  // namespace field_fusion::test
