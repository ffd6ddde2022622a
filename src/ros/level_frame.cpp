#include "field_fusion/ros/level_frame.h"

#include <stdexcept>

#include "field_fusion/core/base/level.h"
#include "field_fusion/ros/recording.h"

namespace field_fusion {

void LevelFrame::setParams(const LevelParams& params) {
  if (!broadcaster_) broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  params_ = params;
}

bool LevelFrame::ready(const std_msgs::Header& header, const TfCache& tf) const {
  return tf.has(params_.base_frame, header) &&
         (params_.up_frame.empty() || tf.has(params_.up_frame, params_.base_frame, header.stamp));
}

core::Transform LevelFrame::send(const ros::Time& stamp, const TfCache& tf) {
  const bool level = params_.up_frame.empty();
  const auto T_up_base =
      level ? core::Transform::Identity() : tf.lookup(params_.up_frame, params_.base_frame, stamp);
  const auto T_plane_base = core::overLevelPlane(T_up_base, params_.base_height - params_.plane_height);
  if (!T_plane_base.matrix().allFinite())
    throw std::runtime_error("the robot stands on end: it has no heading");
  broadcaster_->sendTransform(
      transformMessage(stamp, params_.base_frame, params_.plane_frame, T_plane_base.inverse()));
  return T_plane_base;
}

core::Transform LevelFrame::sensor(const core::Transform& T_plane_base, const ros::Time& stamp,
                                   const std_msgs::Header& header, const TfCache& tf) const {
  const auto T_base_sensor = tf.lookup(params_.base_frame, header);
  if (params_.up_frame.empty() || header.stamp == stamp) return T_plane_base * T_base_sensor;
  const auto& up = params_.up_frame;
  const auto T_base_up = tf.lookup(up, params_.base_frame, stamp).inverse();
  return T_plane_base * T_base_up * tf.lookup(up, params_.base_frame, header.stamp) * T_base_sensor;
}

std_msgs::Header LevelFrame::header(const ros::Time& stamp) const {
  std_msgs::Header out;
  out.stamp = stamp;
  out.frame_id = params_.plane_frame;
  return out;
}

}  // namespace field_fusion
