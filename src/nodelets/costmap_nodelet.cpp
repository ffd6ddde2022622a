// clusters, obstacles, points -> [points, scan] -> obstacle_points, obstacle_scan, obstacle_detections
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/convert.h"
#include "field_fusion/ros/costmap_feed.h"
#include "field_fusion/ros/stage.h"
#include "field_fusion/ros/vision_output.h"

namespace field_fusion {

class CostmapNodelet : public StageNodelet<CostmapParams> {
  void onStart() override {
    onParams();
    points_ = output<CloudMessage>("obstacle_points");
    scan_ = output<sensor_msgs::LaserScan>("obstacle_scan");
    vision_.start([this](auto* m) { return output<std::decay_t<decltype(*m)>>("obstacle_detections"); });
    input<ClusterArray>("clusters", [this](const auto& clusters) { check(*clusters), feed_.add(clusters); });
    input<CloudMessage>("points", [this](const auto& points) { feed_.add(points); }).optional = true;
    const auto ready = [this](const auto& o) { return feed_.ready(o) && tf().has(params().frame, o.header); };
    input<ObstacleArray>(
        "obstacles", [this](const auto& obstacles) { onObstacles(*obstacles); }, ready);
  }

  void onParams() override { feed_.setParams(params()); }
  void onTimeJump() override { feed_.reset(); }

  void onObstacles(const ObstacleArray& obstacles) {
    check(obstacles);
    vision_.publish(obstacles, params().class_names);
    const auto& header = obstacles.header;
    const auto& frame = params().frame.empty() ? header.frame_id : params().frame;
    const auto points = feed_.take(obstacles, frame, tf().lookup(frame, header));
    if (!points.cloud) return;
    from_lidar_ = points.from_lidar;
    from_camera_ = points.cloud->points.size() - points.from_lidar;
    if (!scan_.unwanted()) scan_.publish(feed_.scan(points));
    points_.publish(points.cloud);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    status.add("last obstacles: points of the LiDAR", from_lidar_);
    status.add("last obstacles: points of the camera alone", from_camera_);
  }

  CostmapFeed feed_;
  std::size_t from_lidar_ = 0, from_camera_ = 0;
  Output<CloudMessage> points_;
  Output<sensor_msgs::LaserScan> scan_;
  VisionOutput vision_;
};
using CostmapStage = Unloadable<CostmapNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::CostmapStage, nodelet::Nodelet)
