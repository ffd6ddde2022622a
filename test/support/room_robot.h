#pragma once
// A robot in the analytic room (core/map/room.h): its scans as messages, and where it and its odometry are.
#include "core/map/room.h"
#include "field_fusion/ros/scan_message.h"

namespace field_fusion::test {

struct RoomRobot {
  static constexpr double kAhead = 0.3;  ///< [m] of the scanner before the robot's middle

  double now = 1e6;  ///< [s]
  core::Pose2 truth{0.0, -1.0, 0.0}, odom = truth;

  /// All round, in frame "laser", or in "upside": upside down and turned to the left.
  sensor_msgs::LaserScan scan(const std::string& frame, int beams = 360) const {
    core::Scan out;
    out.angle_increment = core::radians(360.0) / beams, out.range_max = 40.0;
    const core::Pose2 at = truth * core::Pose2{kAhead, 0.0, 0.0};
    for (int k = 0; k < beams; ++k) {
      const double angle = frame == "upside" ? core::radians(90.0) - out.angle(k) : out.angle(k);
      out.ranges.push_back(static_cast<float>(roomRange(at.x, at.y, at.yaw + angle)));
    }
    std_msgs::Header header;
    header.frame_id = frame, header.stamp.fromSec(now);
    return *scanMessage(header, out);
  }
  /// 0.1 s; odometry goes 3 % too far and turns too little.
  void walk() {
    now += 0.1;
    truth = truth * core::Pose2{0.1, 0.0, 0.08}, odom = odom * core::Pose2{0.103, 0.0, 0.078};
  }
};

}  // namespace field_fusion::test
