// points -> [clusterer] -> clusters
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/core/cloud/cluster.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/convert.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class ClusterNodelet : public StageNodelet<core::ClusterParams> {
  void onStart() override {
    onParams();
    clusters_ = output<ClusterArray>("clusters");
    input<CloudMessage>("points", [this](const auto& cloud) { onCloud(*cloud); });
  }

  void onParams() override { clusterer_.setParams(params()); }

  void onCloud(const CloudMessage& cloud) {
    const auto& found = clusterer_.run(cloud.points);
    clusters_.publish(clusterMessage(cloud.header, found));
    noise_ = found.noise;
    too_large_ = found.too_large;
    unusable_ = found.unusable;
    faint_ = found.faint;
    count_ = found.clusters.size() - found.faint;
    row_gap_ = cloud.points.empty() ? row_gap_ : found.row_gap;
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    if (too_large_ > 0)
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "clusters above max_points are left out");
    if (row_gap_ == 0.0)
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "no rings in the cloud: set row_gap");
    status.add("last cloud: clusters", count_);
    status.add("last cloud: angle between rows [deg]", core::degrees(row_gap_));
    status.add("last cloud: faint clusters", faint_);
    status.add("last cloud: noise points", noise_);
    status.add("last cloud: clusters left out as too large", too_large_);
    status.add("last cloud: points not finite or too far", unusable_);
  }

  core::Clusterer clusterer_;
  double row_gap_ = core::kNaN;
  std::size_t count_ = 0, faint_ = 0, noise_ = 0, too_large_ = 0, unusable_ = 0;
  Output<ClusterArray> clusters_;
};
using ClusterStage = Unloadable<ClusterNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::ClusterStage, nodelet::Nodelet)
