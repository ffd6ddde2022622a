// some scans -> [level plane close above the ground, nearest of each beam] -> scan_merged
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/merge_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class ScanMergeNodelet : public StageNodelet<ScanMergeParams> {
  void onStart() override {
    onParams();
    merged_ = output<sensor_msgs::LaserScan>("scan_merged");
    for (std::size_t i = 0; i < params().scans.size(); ++i)
      scans_.push_back(&input<sensor_msgs::LaserScan>(
          params().scans[i], [this, i](const auto& scan) { onScan(i, scan); },
          [this](const auto& scan) { return flow_.ready(scan.header, tf()); }));
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.reset(); }

  void onScan(std::size_t input, const sensor_msgs::LaserScan::ConstPtr& scan) {
    std::vector<std::string> faults;
    const auto merged = flow_.run(input, scan, tf(), faults);
    for (std::size_t i = 0; i < faults.size(); ++i)
      if (!faults[i].empty()) fault(*scans_[i], scan->header.stamp, faults[i]);
    if (merged) merged_.publish(merged);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  MergeFlow flow_;
  std::vector<InputPort*> scans_;
  Output<sensor_msgs::LaserScan> merged_;
};
using ScanMergeStage = Unloadable<ScanMergeNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::ScanMergeStage, nodelet::Nodelet)
