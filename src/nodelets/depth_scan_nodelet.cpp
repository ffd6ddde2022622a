// image and camera_info, or points -> [height band over the ground, nearest of each beam] -> depth_scan
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/camera_feed.h"
#include "field_fusion/ros/depth_scan_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class DepthScanNodelet : public StageNodelet<DepthScanStageParams> {
  void onStart() override {
    onParams();
    scan_ = output<sensor_msgs::LaserScan>("depth_scan");
    if (params().source == DepthScanStageParams::Source::kPoints) {
      input<CloudMessage>(
          "points", [this](const auto& cloud) { scan_.publish(flow_.run(*cloud, tf())); },
          [this](const auto& cloud) { return flow_.ready(cloud.header, tf()); });
      return;
    }
    input<sensor_msgs::CameraInfo>("camera_info", [this](const auto& info) { camera_.add(*info); });
    imageInput(
        "image", [this](const auto& image) { onImage(*image); },
        [this](const auto& i) { return camera_.ready(i.header.stamp) && flow_.ready(i.header, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { camera_.reset(); }

  void onImage(const sensor_msgs::Image& image) {
    std::string why;
    const auto camera = camera_.modelFor(image, why);
    if (!camera) throw std::runtime_error(why);
    scan_.publish(flow_.run(image, *camera, tf()));
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    const auto& counts = flow_.counts();
    if (flow_.blind()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "the last depth has no point at all");
    status.add("last depth: points seen", counts.seen);
    status.add("last depth: floor", counts.floor);
    status.add("last depth: above the band", counts.above);
    status.add("last depth: outside the range", counts.out_of_range);
    status.add("last depth: on the body", counts.body);
    status.add("last depth: kept", counts.kept);
    status.add("last depth: of these noise", counts.noise);
  }

  DepthScanFlow flow_;
  CameraFeed camera_;
  Output<sensor_msgs::LaserScan> scan_;
};
using DepthScanStage = Unloadable<DepthScanNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::DepthScanStage, nodelet::Nodelet)
