// points -> [plane RANSAC, local height over it] -> points_obstacle, points_ground, ground_plane
#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/convert_ground.h"
#include "field_fusion/ros/stage.h"
#include "field_fusion/ros/stage_declarations.h"

namespace field_fusion {

class GroundNodelet : public StageNodelet<GroundStageParams> {
  void onStart() override {
    onParams();
    obstacle_ = output<CloudMessage>("points_obstacle");
    ground_ = output<CloudMessage>("points_ground");
    plane_ = output<GroundPlane>("ground_plane");
    input<CloudMessage>(
        "points", [this](const auto& cloud) { onCloud(*cloud); },
        [this](const auto& cloud) { return tf().has(params().up_frame, cloud.header); });
  }

  void onParams() override { finder_.setParams(params().ground); }
  void onTimeJump() override { finder_.reset(); }

  void onCloud(const CloudMessage& cloud) {
    const auto& header = cloud.header;
    const auto T_up_sensor = tf().lookup(params().up_frame, header);
    const Eigen::Vector3d up = T_up_sensor.linear().transpose() * Eigen::Vector3d::UnitZ();
    auto ground = boost::make_shared<CloudMessage>(), obstacle = boost::make_shared<CloudMessage>();
    ground->header = obstacle->header = header;
    last_ = finder_.run(cloud.points, header.stamp.toSec(), ground->points, obstacle->points, up);
    plane_.publish(groundMessage(header, last_));
    ground_.publish(ground);
    obstacle_.publish(obstacle);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    if (!last_.found())
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                          std::string("no ground: ") + describe(last_.fault));
    status.add("ground: points on the plane", last_.inliers);
    status.add("ground: points below the plane", last_.below);
    status.add("ground: height of the sensor [m]", last_.plane.offset);
    status.add("ground: tilt [deg]", core::degrees(last_.tilt));
    status.add("ground: confidence", last_.confidence);
  }

  core::GroundFinder finder_;
  core::Ground last_;
  Output<CloudMessage> obstacle_, ground_;
  Output<GroundPlane> plane_;
};
using GroundStage = Unloadable<GroundNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::GroundStage, nodelet::Nodelet)
