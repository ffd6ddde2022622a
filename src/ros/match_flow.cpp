#include "field_fusion/ros/match_flow.h"

#include "field_fusion/ros/convert.h"

namespace field_fusion {
namespace {

boost::shared_ptr<const ClusterArray> clustersIn(const core::Sync::Frame& frame) {
  return boost::static_pointer_cast<const ClusterArray>(frame.clusters);
}

boost::shared_ptr<const ImageDetectionArray> detectionsIn(const core::Sync::Frame& frame,
                                                          std::size_t camera) {
  return boost::static_pointer_cast<const ImageDetectionArray>(frame.answers[camera].detections);
}

}  // namespace

MatchFlow::MatchFlow(const core::MatchParams& params, const TfCache& tf)
    : params_(params),
      tf_(tf),
      matcher_(params),
      sync_(params.sync),
      record_(params),
      frame_(params.frame) {}

void MatchFlow::reset() {
  sync_.reset();
  record_.reset();
}

boost::shared_ptr<ObstacleArray> MatchFlow::add(const ClusterArray::ConstPtr& clusters, ros::WallTime now) {
  frame_ = clusters->header.frame_id;
  const bool more = sync_.addClusters(clusters->header.stamp.toSec(), now.toSec(), clusters);
  return obstacleMessage(clusters->header, 0, more,
                         matcher_.run(clustersOf(*clusters), pointsOf(*clusters), {}));
}

bool MatchFlow::placeable(std::size_t camera, const ImageDetectionArray& detections) const {
  const auto& header = detections.header;
  const auto stamp = header.stamp + ros::Duration(params_.sync.offsetOf(camera));
  return frame_.empty() || tf_.has(frame_, header.frame_id, stamp);
}

std::vector<std::string> MatchFlow::add(std::size_t camera, const ImageDetectionArray::ConstPtr& detections,
                                        ros::WallTime now) {
  std::vector<std::string> faults(1);
  const auto sound = soundDetections(detections, faults[0]);
  if (faults[0].empty()) faults.clear();
  if (!sync_.addDetections(camera, sound->header.stamp.toSec(), now.toSec(), sound))
    faults.push_back(
        "too late for clusters: these wait no longer than partner_timeout, nor for a camera that was silent for "
        "so long");
  return faults;
}

std::optional<MatchFlow::Matched> MatchFlow::next(ros::WallTime now) {
  const auto frame = sync_.next(now.toSec());
  if (!frame) return std::nullopt;
  record_.add(*frame, ros::Time::now().toSec());
  Matched out;
  const auto header = headerOf(*frame);
  out.stamp = header.stamp;
  if (frame->clusters) out.arrival = ros::WallTime(frame->arrival);
  out.faults.resize(frame->answers.size());
  if (!frame->clusters && header.frame_id.empty()) {
    out.faults[frame->leader] =
        "no frame for what cameras see: no clusters yet, and parameter frame is empty";
    return out;
  }
  std::vector<std::optional<core::CameraView>> views;
  for (std::size_t i = 0; i < frame->answers.size(); ++i) views.push_back(viewOf(i, *frame, out.faults[i]));
  static const ClusterArray none;
  const auto clusters = clustersIn(*frame);
  const ClusterArray& bodies = clusters ? *clusters : none;
  const auto& obstacles = matcher_.run(clustersOf(bodies), pointsOf(bodies), views);
  record_.add(header.stamp.toSec(), obstacles);
  out.obstacles = obstacleMessage(header, 1, false, obstacles);
  return out;
}

std_msgs::Header MatchFlow::headerOf(const core::Sync::Frame& frame) const {
  if (frame.clusters) return clustersIn(frame)->header;
  std_msgs::Header header;
  header.frame_id = frame_;
  header.stamp =
      detectionsIn(frame, frame.leader)->header.stamp + ros::Duration(params_.sync.offsetOf(frame.leader));
  return header;
}

std::optional<core::CameraView> MatchFlow::viewOf(std::size_t camera, const core::Sync::Frame& frame,
                                                  std::string& fault) const {
  const auto detections = detectionsIn(frame, camera);
  if (!detections) return std::nullopt;
  const auto stamp = detections->header.stamp + ros::Duration(params_.sync.offsetOf(camera));
  const std::string& target = frame.clusters ? clustersIn(frame)->header.frame_id : frame_;
  try {
    const auto T_lidar_camera = tf_.lookup(target, detections->header.frame_id, stamp);
    return cameraViewOf(*detections, &T_lidar_camera);
  } catch (const std::runtime_error& e) {
    fault = e.what();
  }
  return cameraViewOf(*detections, nullptr);
}

void MatchFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  record_.describe(sync_.counts(), status);
}

}  // namespace field_fusion
