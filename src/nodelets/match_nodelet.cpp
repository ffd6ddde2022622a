// clusters, detections of some cameras -> [bring together by stamp, match] -> obstacles
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/convert.h"
#include "field_fusion/ros/match_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class MatchNodelet : public StageNodelet<core::MatchParams> {
  void onStart() override {
    flow_ = std::make_unique<MatchFlow>(params(), tf());
    obstacles_ = output<ObstacleArray>("obstacles");
    clusters_ = &input<ClusterArray>("clusters", [this](const auto& clusters) { onClusters(clusters); });
    clusters_->deferred = true;  // until their last revision
    for (std::size_t i = 0; i < params().sync.cameraCount(); ++i)
      detections_.push_back(&input<ImageDetectionArray>(
          params().sync.topicOf(i), [this, i](const auto& detections) { onDetections(i, detections); },
          [this, i](const auto& detections) { return flow_->placeable(i, detections); }));
    poll_ = every(0.01, [this] { release(); });
  }
  void onParams() override { flow_->onParams(); }
  void onTimeJump() override { flow_->reset(); }
  void onClusters(const ClusterArray::ConstPtr& clusters) {
    check(*clusters);
    const auto now = ros::WallTime::now();
    const auto obstacles = flow_->add(clusters, now);
    obstacles_.publish(obstacles);
    if (!obstacles->provisional) count(*clusters_, now);
    release();
  }
  void onDetections(std::size_t camera, const ImageDetectionArray::ConstPtr& detections) {
    for (const auto& text : flow_->add(camera, detections, ros::WallTime::now()))
      fault(*detections_[camera], detections->header.stamp, text);
    release();
  }
  void release() {
    while (const auto matched = flow_->next(ros::WallTime::now())) {
      if (matched->obstacles) obstacles_.publish(matched->obstacles);
      if (matched->arrival) count(*clusters_, *matched->arrival);
      for (std::size_t i = 0; i < matched->faults.size(); ++i)
        if (!matched->faults[i].empty()) fault(*detections_[i], matched->stamp, matched->faults[i]);
    }
    flow_->idle() ? poll_.stop() : poll_.start();
  }
  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_->describe(s); }

  std::unique_ptr<MatchFlow> flow_;
  Output<ObstacleArray> obstacles_;
  InputPort* clusters_ = nullptr;
  std::vector<InputPort*> detections_;
  ros::WallTimer poll_;
};
using MatchStage = Unloadable<MatchNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::MatchStage, nodelet::Nodelet)
