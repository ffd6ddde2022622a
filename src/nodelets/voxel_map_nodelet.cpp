// points, or image and camera_info -> [rays through voxels, as OctoMap] -> projected_map (map B), voxels, octree
#include <pluginlib/class_list_macros.hpp>
#include <std_srvs/Empty.h>

#include "field_fusion/ros/octomap_output.h"
#include "field_fusion/ros/stage.h"
#include "field_fusion/ros/voxel_flow.h"

namespace field_fusion {

class VoxelMapNodelet : public StageNodelet<VoxelStageParams> {
 public:
  VoxelMapNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override {
    onParams();
    map_ = output<nav_msgs::OccupancyGrid>("projected_map");
    voxels_ = output<visualization_msgs::MarkerArray>("voxels", true);
    tree_.start([this](auto* m, auto topic) { return output<std::decay_t<decltype(*m)>>(topic, true); });
    service<SaveMap>("save_voxels", [this](auto& request, auto& answer) { flow_.save(request, answer); });
    service<std_srvs::Empty>("reset_voxels", [this](auto&, auto&) { flow_.clear(); });
    if (params().source == VoxelStageParams::Source::kPoints) {
      input<CloudMessage>("points", [this](const auto& cloud) { flow_.run(*cloud, tf()), send(); },
                          [this](const auto& cloud) { return flow_.ready(cloud.header, tf()); });
      return;
    }
    input<sensor_msgs::CameraInfo>("camera_info", [this](const auto& info) { camera_.add(*info); });
    imageInput("image", [this](const auto& image) { flow_.run(*image, camera_, tf()), send(); },
               [this](const auto& i) { return camera_.ready(i.header.stamp) && flow_.ready(i.header, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { camera_.reset(), flow_.reset(); }
  void onListener() override { flow_.hasMap() ? sendVoxels() : void(); }

  void send() {
    if (!map_.unwanted() && flow_.mapIsDue()) map_.publish(flow_.projected());
    if (!(voxels_.unwanted() && tree_.unwanted()) && flow_.voxelsAreDue()) sendVoxels();
  }
  void sendVoxels() {
    if (!voxels_.unwanted()) voxels_.publish(flow_.voxels());
    tree_.publish(flow_.header(), flow_.map());
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  VoxelFlow flow_;
  CameraFeed camera_;
  Output<nav_msgs::OccupancyGrid> map_;
  Output<visualization_msgs::MarkerArray> voxels_;
  OctomapOutput tree_;
};
using VoxelMapStage = Unloadable<VoxelMapNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::VoxelMapStage, nodelet::Nodelet)
