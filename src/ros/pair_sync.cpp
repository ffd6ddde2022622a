#include "field_fusion/ros/pair_sync.h"

#include <algorithm>

namespace field_fusion {

bool PairSync::add(const ClusterArray::ConstPtr& clusters, ros::WallTime now) {
  if (clusters->header.stamp <= last_clusters_) reset();
  last_clusters_ = clusters->header.stamp;
  if (camera_heard_.isZero()) camera_heard_ = now;
  waiting_.push_back({{clusters, now, nullptr}});
  const auto late = counts_.late;
  clusters_in_.add(clusters);
  if (waiting_.size() > static_cast<std::size_t>(params_.queue_size)) waiting_.front().settled = true;
  return counts_.late == late;
}

bool PairSync::add(const ImageDetectionArray::ConstPtr& detections, ros::WallTime now) {
  if (detections->header.stamp <= last_detections_) reset();
  last_detections_ = detections->header.stamp;
  camera_heard_ = now;
  const auto late = counts_.late;
  detections_in_.add(detections);
  return counts_.late == late;
}

std::optional<PairSync::Pair> PairSync::next(ros::WallTime now) {
  if (waiting_.empty()) return std::nullopt;
  if (!waiting_.front().settled && !expired(waiting_.front().pair, now)) return std::nullopt;
  Pair pair = std::move(waiting_.front().pair);
  waiting_.pop_front();
  ++(pair.detections ? counts_.pairs : counts_.alone);
  return pair;
}

void PairSync::reset() {
  Policy policy(static_cast<std::uint32_t>(params_.queue_size));
  policy.setMaxIntervalDuration(ros::Duration(params_.max_interval));
  policy.setInterMessageLowerBound(0, ros::Duration(params_.cluster_spacing));
  policy.setInterMessageLowerBound(1, ros::Duration(params_.detection_spacing));
  sync_ = std::make_unique<message_filters::Synchronizer<Policy>>(std::as_const(policy), clusters_in_,
                                                                  detections_in_);
  sync_->registerCallback(&PairSync::onPair, this);
  waiting_.clear();
  last_clusters_ = last_detections_ = ros::Time();
  camera_heard_ = ros::WallTime();
}

// Only notes the pair: the synchroniser is in the middle of its work here and must not see an exception.
void PairSync::onPair(const ClusterArray::ConstPtr& clusters,
                      const ImageDetectionArray::ConstPtr& detections) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& w) { return w.pair.clusters == clusters; });
  if (found == waiting_.end()) {
    ++counts_.late;
    return;
  }
  found->pair.detections = detections;
  for (auto passed = waiting_.begin(); passed <= found; ++passed) passed->settled = true;
}

bool PairSync::expired(const Pair& pair, ros::WallTime now) const {
  return (now - std::min(pair.arrival, camera_heard_)).toSec() >= params_.partner_timeout;
}

}  // namespace field_fusion
