#pragma once
// A frame that follows the robot over the ground without its pitch and roll: the plane of made-up scans.
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <string>

#include "field_fusion/core/base/params.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

struct LevelParams {
  /// Each stage has a plane of its own: two that send one frame with the same stamp are at odds.
  explicit LevelParams(std::string plane) : plane_frame(std::move(plane)) {}

  std::string base_frame = "base";
  std::string up_frame;
  std::string plane_frame;
  double base_height = 0.0;
  double plane_height = 0.1;

  void declare(core::Params& p) {
    p.text("base_frame", base_frame, core::When::kStart, "The robot's own frame, x ahead.");
    p.text("up_frame", up_frame, core::When::kStart,
           "Frame whose z axis is up, such as odom, to take pitch and roll out; empty: base_frame is level.");
    p.text("plane_frame", plane_frame, core::When::kStart,
           "Frame of the scan: right below base_frame, level, with its heading. The stage sends it to TF.");
    p.number("base_height", base_height, {-10.0, 10.0}, "m", core::When::kLive,
             "Of base_frame over the ground; 0: it lies on it.");
    p.number("plane_height", plane_height, {-10.0, 10.0}, "m", core::When::kLive,
             "Of the scan over the ground; paper 004 has 0.1.");
    p.rule([this] { return !base_frame.empty() && !plane_frame.empty(); },
           "base_frame and plane_frame must have names");
    p.rule([this] { return base_frame != plane_frame; }, "base_frame and plane_frame must differ");
  }
};

class LevelFrame {
 public:
  /// From the first call on others can listen to the frame; not before ROS runs.
  void setParams(const LevelParams& params);

  /// Whether the pose of the base, and that of a sensor on it, is known at the stamp of the message.
  bool ready(const std_msgs::Header& header, const TfCache& tf) const;
  /// T_plane_base at a stamp, which also goes to TF. Throws std::runtime_error where a transform is missing
  /// or the robot stands on end.
  core::Transform send(const ros::Time& stamp, const TfCache& tf);
  /// T_plane_sensor, the plane at `stamp` and the sensor at its own. Without up_frame both instants are one.
  core::Transform sensor(const core::Transform& T_plane_base, const ros::Time& stamp,
                         const std_msgs::Header& header, const TfCache& tf) const;
  std_msgs::Header header(const ros::Time& stamp) const;

 private:
  LevelParams params_{""};
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
};

}  // namespace field_fusion
