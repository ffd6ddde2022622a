#pragma once
// The way of a sensor while it measures, from messages of odometry or of an inertial unit.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <string>

#include "field_fusion/core/base/inertial.h"
#include "field_fusion/core/base/motion_track.h"
#include "field_fusion/ros/port.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

/// Queue of an input at some hundred messages a second.
constexpr std::uint32_t kFastQueue = 200;

struct MotionParams {
  core::PoseHistoryParams history;
  core::InertialParams inertial;
  core::Instant instant = core::Instant::kStart;
  enum class Fallback { kRaw, kDrop } fallback = Fallback::kRaw;
  std::string base_frame;

  void declare(core::Params& p) {
    p.choice("instant", instant, {"start", "middle", "end"}, core::When::kLive,
             "When all points are as if measured; the stamp of the output.");
    p.choice(
        "fallback", fallback, {"raw", "drop"}, core::When::kLive,
        "What happens where the motion is not known hold_limit after the message came: it goes out as it "
        "came, with its point times, or not at all.");
    p.text("base_frame", base_frame, core::When::kStart,
           "Frame whose pose the odometry tells; empty: its child_frame_id.");
    history.declare(p);
    inertial.declare(p);
  }
};

/// Odometry or an inertial unit, whichever is added; both at once is not meant.
class MotionSource {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const MotionParams& params);

  /// Both throw std::runtime_error "pose damaged: ..." or "imu damaged: ...".
  void add(const nav_msgs::Odometry& odometry);
  void add(const sensor_msgs::Imu& imu);
  void reset();

  /// False while what is missing may still come.
  bool ready(const std_msgs::Header& header, const core::Sweep& sweep, const TfCache& tf) const;

  /// Makes the track of the sensor of `header`; empty, or why it cannot be told.
  std::string follow(const std_msgs::Header& header, const core::Sweep& sweep, const TfCache& tf,
                     core::MotionTrack& track) const;

 private:
  void add(const std_msgs::Header& header, const std::string& frame, core::TimedPose pose);

  MotionParams params_;
  core::PoseHistory history_;
  core::Inertial inertial_;
  std::string frame_;  // whose poses are in the history
};

/// How many messages went on raw and why; a warning while it goes on. `what`: "scans".
void describeRaw(const FaultLog& raw, const std::string& what, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace field_fusion
