#pragma once
// From messages of scans and the odometry of TF to a map, and where the robot is in it.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <nav_msgs/GetMap.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float64.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>

#include "field_fusion/SaveMap.h"
#include "field_fusion/core/io/map_file.h"
#include "field_fusion/core/map/local_map.h"
#include "field_fusion/ros/grid_message.h"
#include "field_fusion/ros/slam_messages.h"
#include "field_fusion/ros/slam_params.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

class SlamFlow {
 public:
  struct News {
    bool taken = false;  ///< the scan is in the map
    bool map = false;    ///< it is time for map and path
  };

  /// The first time not before ROS runs; loads the map. Throws std::invalid_argument with every fault of the
  /// parameters, std::runtime_error for the map.
  void setParams(const SlamStageParams& params);
  bool ready(const std_msgs::Header& header, const TfCache& tf) const;
  void reset();
  /// Time went back: the map begins anew with the next scan, unless that is newer than all that the map has. A single stamp
  /// from the future, of a scan that was dropped, must not cost hours of mapping.
  void onTimeJump() { jumped_ = true; }

  /// Takes a scan in, where the robot has moved, and sends map_frame to odom_frame. Throws std::runtime_error "scan
  /// damaged: ..." or where a transform is missing.
  News run(const sensor_msgs::LaserScan& scan, const TfCache& tf);

  // of the last scan
  boost::shared_ptr<nav_msgs::OccupancyGrid> map() { return gridMessage(header_, drawer_.update(slam_->best().map)); }
  boost::shared_ptr<nav_msgs::OccupancyGrid> localMap();
  boost::shared_ptr<geometry_msgs::PoseArray> particles() const { return particlesMessage(header_, *slam_); }
  boost::shared_ptr<nav_msgs::Path> path() const { return pathMessage(header_, *slam_); }
  boost::shared_ptr<std_msgs::Float64> entropy() const;

  /// Throws std::runtime_error where there is no map yet.
  void answer(nav_msgs::GetMap::Response& answer);
  void save(const SaveMap::Request& request, SaveMap::Response& answer);
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  void sendTransform(const core::Pose2& T_odom_base);
  void noteFit();

  SlamStageParams params_;
  std::unique_ptr<core::GridSlam> slam_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
  core::TileMap loaded_;
  core::OccupancyDrawer drawer_;
  core::LocalMap local_;
  std_msgs::Header header_;
  ros::Time drawn_;  // stamp at which the map last went out
  bool last_blind_ = false, jumped_ = false;
  ros::Time misfit_, odometry_jump_;  // stamps of the last scan that did not fit, and after a jump
  std::uint64_t blind_ = 0, taken_ = 0, misfits_ = 0;
};

}  // namespace field_fusion
