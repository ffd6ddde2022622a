// scan, odometry by TF -> [Rao-Blackwellised particle filter] -> map, local_map, particles, path, map -> odom
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/slam_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class GridSlamNodelet : public StageNodelet<SlamStageParams> {
 public:
  GridSlamNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override {
    onParams();
    map_ = output<nav_msgs::OccupancyGrid>("map", true), meta_ = output<nav_msgs::MapMetaData>("map_metadata", true);
    local_ = output<nav_msgs::OccupancyGrid>("local_map"), path_ = output<nav_msgs::Path>("path");
    particles_ = output<geometry_msgs::PoseArray>("particles"), entropy_ = output<std_msgs::Float64>("~entropy");
    service<nav_msgs::GetMap>("dynamic_map", [this](auto&, auto& out) { flow_.answer(out); });
    service<SaveMap>("save_map", [this](auto& request, auto& answer) { flow_.save(request, answer); });
    input<sensor_msgs::LaserScan>(
        "scan", [this](const auto& scan) { onScan(*scan); },
        [this](const auto& scan) { return flow_.ready(scan.header, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.onTimeJump(); }

  void onScan(const sensor_msgs::LaserScan& scan) {
    const auto news = flow_.run(scan, tf());
    if (!news.taken) return;
    entropy_.publish(flow_.entropy());
    if (!particles_.unwanted()) particles_.publish(flow_.particles());
    if (!local_.unwanted()) local_.publish(flow_.localMap());
    if (!news.map) return;
    if (!path_.unwanted()) path_.publish(flow_.path());
    const auto map = flow_.map();
    meta_.publish(boost::make_shared<nav_msgs::MapMetaData>(map->info));
    map_.publish(map);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  SlamFlow flow_;
  Output<nav_msgs::OccupancyGrid> map_, local_;
  Output<nav_msgs::MapMetaData> meta_;
  Output<nav_msgs::Path> path_;
  Output<geometry_msgs::PoseArray> particles_;
  Output<std_msgs::Float64> entropy_;
};
using GridSlamStage = Unloadable<GridSlamNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::GridSlamStage, nodelet::Nodelet)
