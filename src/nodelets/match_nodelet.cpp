// clusters, detections -> [pair by stamp, match] -> obstacles
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/convert.h"
#include "field_fusion/ros/match_pair.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class MatchNodelet : public StageNodelet<core::MatchParams> {
  void onStart() override {
    onParams();
    sync_ = std::make_unique<PairSync>(params().sync);
    obstacles_ = output<ObstacleArray>("obstacles");
    clusters_ = &input<ClusterArray>("clusters", [this](const auto& clusters) { add(clusters); });
    clusters_->deferred = true;  // until they go out
    detections_ = &input<ImageDetectionArray>(
        "detections", [this](const auto& detections) { add(detections); },
        [this](const auto& detections) { return tf().has(frame_, detections.header); });
    poll_ = every(0.01, [this] { release(); });
  }

  void onParams() override { matcher_.setParams(params()); }
  void onTimeJump() override { sync_->reset(); }
  template <class Pointer>
  void add(const Pointer& message) {
    check(*message);
    const bool in_time = sync_->add(message, ros::WallTime::now());
    if (!in_time) fault(*detections_, message->header.stamp, "too late for clusters");
    release();
  }
  void release() {
    while (const auto pair = sync_->next(ros::WallTime::now())) publish(*pair);
    sync_->empty() ? poll_.stop() : poll_.start();
  }
  void publish(const PairSync::Pair& pair) {
    std::string no_place;  // why the camera's bodies have none
    frame_ = pair.clusters->header.frame_id;
    obstacles_.publish(matchPair(matcher_, pair, tf(), no_place));
    count(*clusters_, pair.arrival);
    if (!no_place.empty()) fault(*detections_, pair.detections->header.stamp, no_place);
  }
  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    const auto& n = sync_->counts();
    status.addf("pairs, clusters alone, detections too late", "%lu %lu %lu", n.pairs, n.alone, n.late);
  }
  core::Matcher matcher_;
  std::unique_ptr<PairSync> sync_;
  std::string frame_;  // of the last clusters; empty: none yet
  Output<ObstacleArray> obstacles_;
  InputPort *clusters_ = nullptr, *detections_ = nullptr;
  ros::WallTimer poll_;
};
using MatchStage = Unloadable<MatchNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::MatchStage, nodelet::Nodelet)
