// points with times, odom or imu -> [each point at one instant] -> points_deskewed
#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/cloud_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class DeskewCloudNodelet : public StageNodelet<DeskewCloudParams> {
 public:
  DeskewCloudNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override {
    onParams();
    points_ = output<CloudMessage>("points_deskewed");
    if (params().method == DeskewCloudParams::Method::kOdometry)
      input<nav_msgs::Odometry>("odom", [this](const auto& odom) { flow_.motion().add(*odom); }).queue =
          kFastQueue;
    else
      input<sensor_msgs::Imu>("imu", [this](const auto& imu) { flow_.motion().add(*imu); }).queue =
          kFastQueue;
    input<CloudMessage>(
        "points", [this](const auto& cloud) { onCloud(cloud); },
        [this](const auto& cloud) { return flow_.ready(cloud, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.reset(); }

  void onCloud(const CloudMessage::ConstPtr& cloud) {
    const auto out = flow_.run(cloud, tf());
    if (out.log) NODELET_WARN_STREAM("cloud " << cloud->header.stamp << " passed on raw, " << flow_.raw());
    points_.publish(out.points);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  CloudFlow flow_;
  Output<CloudMessage> points_;
};
using DeskewCloudStage = Unloadable<DeskewCloudNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::DeskewCloudStage, nodelet::Nodelet)
