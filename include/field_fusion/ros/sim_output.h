#pragma once
// What a simulation gives out, one message at a time: into a bag or to publishers.
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>
#include <boost/shared_ptr.hpp>

#include <functional>
#include <string>
#include <variant>

#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/TruthBodies.h"
#include "field_fusion/ros/cloud_message.h"

namespace field_fusion {

template <class... M>
using AnyOf = std::variant<boost::shared_ptr<const M>...>;

using SimMessage =
    AnyOf<sensor_msgs::LaserScan, CloudMessage, sensor_msgs::PointCloud2, sensor_msgs::Image,
          sensor_msgs::CompressedImage, sensor_msgs::CameraInfo, sensor_msgs::Imu, sensor_msgs::NavSatFix,
          nav_msgs::Odometry, nav_msgs::OccupancyGrid, tf2_msgs::TFMessage, visualization_msgs::MarkerArray,
          TruthBodies, ImageDetectionArray>;

struct SimOutput {
  std::string topic;
  ros::Time time;  ///< when a real sensor would have it ready: at the end of a scan, not at its stamp
  SimMessage message;
  bool latched = false;
};
using SimSink = std::function<void(const SimOutput&)>;

/// ROS takes a stamp of 0 for none: a run starts here.
constexpr double kSimStart = 1000.0;  // s
inline ros::Time simTime(double time) { return ros::Time(kSimStart + time); }

}  // namespace field_fusion
