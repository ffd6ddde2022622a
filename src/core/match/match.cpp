#include "field_fusion/core/match/match.h"

namespace field_fusion::core {

void Matcher::setParams(const MatchParams& params) {
  params_ = params.obstacle;
  tolerance_.setParams(params.tolerance);
}

const std::vector<Obstacle>& Matcher::run(const std::vector<Cluster>& clusters,
                                          const std::vector<CameraTarget>& targets) {
  lidar_.clear();
  for (const Cluster& cluster : clusters) lidar_.push_back(cluster.polar);
  camera_.clear();
  for (const CameraTarget& target : targets) camera_.push_back(target.polar);
  const Verdicts& verdicts = tolerance_.run(lidar_, camera_);

  obstacles_.clear();
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const Verdict& verdict = verdicts.lidar[i];
    const int place = static_cast<int>(i);
    if (verdict.partner < 0)
      obstacles_.push_back(lidarObstacle(clusters[i], place, verdict, params_));
    else
      obstacles_.push_back(matchedObstacle(clusters[i], place, targets[verdict.partner], verdict, params_));
  }
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (verdicts.camera[i].partner < 0)
      obstacles_.push_back(cameraObstacle(targets[i], verdicts.camera[i], params_));
  return obstacles_;
}

const std::vector<Obstacle>& Matcher::runAlone(const std::vector<Cluster>& clusters) {
  Verdict verdict;
  verdict.reason = MatchReason::kNoPartnerMessage;
  obstacles_.clear();
  for (std::size_t i = 0; i < clusters.size(); ++i)
    obstacles_.push_back(lidarObstacle(clusters[i], static_cast<int>(i), verdict, params_));
  return obstacles_;
}

}  // namespace field_fusion::core
