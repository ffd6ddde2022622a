// scan, odom or imu -> [each beam at one instant] -> scan_deskewed, scan_points
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/scan_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class DeskewScanNodelet : public StageNodelet<DeskewScanParams> {
 public:
  DeskewScanNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override {
    onParams();
    scan_ = output<sensor_msgs::LaserScan>("scan_deskewed");
    points_ = output<CloudMessage>("scan_points");
    using Method = DeskewScanParams::Method;
    if (params().method == Method::kOdometry)
      input<nav_msgs::Odometry>("odom", [this](const auto& odom) { flow_.motion().add(*odom); }).queue =
          kFastQueue;
    if (params().method == Method::kImu)
      input<sensor_msgs::Imu>("imu", [this](const auto& imu) { flow_.motion().add(*imu); }).queue =
          kFastQueue;
    input<sensor_msgs::LaserScan>(
        "scan", [this](const auto& scan) { onScan(scan); },
        [this](const auto& scan) { return flow_.ready(scan, tf()); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.reset(); }

  void onScan(const sensor_msgs::LaserScan::ConstPtr& scan) {
    const auto out = flow_.run(scan, tf());
    if (out.log) NODELET_WARN_STREAM("scan " << scan->header.stamp << " passed on raw, " << flow_.raw());
    scan_.publish(out.scan);
    points_.publish(out.points);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  ScanFlow flow_;
  Output<sensor_msgs::LaserScan> scan_;
  Output<CloudMessage> points_;
};
using DeskewScanStage = Unloadable<DeskewScanNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::DeskewScanStage, nodelet::Nodelet)
