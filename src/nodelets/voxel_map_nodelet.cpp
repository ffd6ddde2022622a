// points, or image and camera_info -> [rays through voxels, as OctoMap] -> projected_map (map B), voxels
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/camera_feed.h"
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
    service<SaveMap>("save_voxels", [this](auto& request, auto& answer) { flow_.save(request, answer); });
    if (params().source == VoxelStageParams::Source::kPoints) {
      input<CloudMessage>(
          "points", [this](const auto& cloud) { flow_.run(*cloud, tf()), send(); },
          [this](const auto& cloud) { return flow_.ready(cloud.header, tf()); });
      return;
    }
    input<sensor_msgs::CameraInfo>("camera_info", [this](const auto& info) { camera_.add(*info); });
    imageInput(
        "image", [this](const auto& image) { onImage(*image); },
        [this](const auto& i) { return camera_.ready(i.header.stamp) && flow_.ready(i.header, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.reset(), camera_.reset(); }

  void onImage(const sensor_msgs::Image& image) {
    std::string why;
    const auto camera = camera_.modelFor(image, why);
    if (!camera) throw std::runtime_error(why);
    flow_.run(image, *camera, tf());
    send();
  }

  void send() {
    if (!map_.unwanted() && flow_.mapIsDue()) map_.publish(flow_.projected());
    if (!voxels_.unwanted() && flow_.voxelsAreDue()) voxels_.publish(flow_.voxels());
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  VoxelFlow flow_;
  CameraFeed camera_;
  Output<nav_msgs::OccupancyGrid> map_;
  Output<visualization_msgs::MarkerArray> voxels_;
};
using VoxelMapStage = Unloadable<VoxelMapNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::VoxelMapStage, nodelet::Nodelet)
