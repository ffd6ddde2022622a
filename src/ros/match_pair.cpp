#include "field_fusion/ros/match_pair.h"

#include "field_fusion/ros/convert.h"

namespace field_fusion {

boost::shared_ptr<ObstacleArray> matchPair(core::Matcher& matcher, const PairSync::Pair& pair,
                                           const TfCache& tf, std::string& fault) {
  const auto& header = pair.clusters->header;
  const auto clusters = clustersOf(*pair.clusters);
  if (!pair.detections) return obstacleMessage(header, 0, matcher.runAlone(clusters));
  std::optional<core::Transform> T_lidar_camera;
  try {
    const auto& camera = pair.detections->header;
    T_lidar_camera = tf.lookup(header.frame_id, camera.frame_id, camera.stamp);
  } catch (const std::runtime_error& e) {
    fault = e.what();
  }
  const auto targets = cameraTargetsOf(*pair.detections, T_lidar_camera ? &*T_lidar_camera : nullptr);
  return obstacleMessage(header, 1, matcher.run(clusters, targets));
}

}  // namespace field_fusion
