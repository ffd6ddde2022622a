#pragma once
// Messages of a body on a known way, for the tests of the deskew stages.
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>

#include "field_fusion/ros/scan_message.h"
#include "support/moving_scanner.h"

namespace field_fusion::test {

inline std_msgs::Header headerAt(double stamp, const std::string& frame) {
  std_msgs::Header out;
  out.frame_id = frame;
  out.stamp.fromSec(stamp);
  return out;
}

inline nav_msgs::Odometry odometryAt(const Motion& motion, double stamp) {
  nav_msgs::Odometry out;
  out.header = headerAt(stamp, "odom");
  out.child_frame_id = "base";
  out.pose.pose = tf2::toMsg(motion(stamp));
  return out;
}

/// Of a body that turns about its upright axis on the spot, at `rate` [rad/s].
inline sensor_msgs::Imu imuAt(double rate, double stamp, const std::string& frame) {
  sensor_msgs::Imu out;
  out.header = headerAt(stamp, frame);
  out.angular_velocity.z = rate;
  out.linear_acceleration.z = 9.81;
  return out;
}

/// Calls `send` with the stamps of [begin, end], 100 a second.
template <class Send>
void everyHundredth(double begin, double end, Send send) {
  const int count = static_cast<int>(std::lround((end - begin) * 100.0));
  for (int i = 0; i <= count; ++i) send(begin + 0.01 * i);
}

/// Largest distance of points from the walls of the room, seen by a scanner at `T_world_scanner`.
inline double offTheWalls(const core::Cloud& points, const core::Transform& T_world_scanner) {
  double out = points.empty() ? std::numeric_limits<double>::infinity() : 0.0;
  for (const auto& p : points) out = std::max(out, Room{}.off(T_world_scanner * p.position().cast<double>()));
  return out;
}

}  // namespace field_fusion::test
