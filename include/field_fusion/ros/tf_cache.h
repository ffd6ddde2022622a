#pragma once
// The one transform buffer of a process.
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <mutex>
#include <string>

#include "field_fusion/core/base/types.h"

namespace field_fusion {

class TfCache {
 public:
  /// The cache that all stages of this process share; made by the first that asks.
  static std::shared_ptr<TfCache> shared();

  TfCache() : listener_(buffer_) {}

  /// T_target_source at `stamp`. Throws std::runtime_error naming both frames, the time and the cause.
  core::Transform lookup(const std::string& target, const std::string& source, const ros::Time& stamp) const;
  bool has(const std::string& target, const std::string& source, const ros::Time& stamp) const;

  /// The same from the frame and stamp of a message; an empty target is the message's own frame.
  core::Transform lookup(const std::string& target, const std_msgs::Header& header) const {
    return target.empty() ? core::Transform::Identity() : lookup(target, header.frame_id, header.stamp);
  }
  bool has(const std::string& target, const std_msgs::Header& header) const {
    return target.empty() || has(target, header.frame_id, header.stamp);
  }

  /// Forgets moving transforms. All stages of a process report the same jump: only the first call within
  /// two seconds of wall time counts, so that none throws away what came after.
  void onTimeJump();

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::mutex mutex_;
  ros::WallTime cleared_;
};

}  // namespace field_fusion
