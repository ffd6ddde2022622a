#pragma once
// Clusters and detections of one instant to obstacles.
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/match/obstacle.h"
#include "field_fusion/core/match/tolerance.h"

namespace field_fusion::core {

enum class MatchMethod { kPaper };

/// How clusters and detections of about the same time find each other.
struct SyncParams {
  double max_interval = 0.05;
  double cluster_spacing = 0.08;
  double detection_spacing = 0.027;
  double partner_timeout = 0.5;
  int queue_size = 30;

  void declare(Params& p) {
    p.number("max_interval", max_interval, {0.0, 1.0}, "s", When::kStart,
             "Clusters and detections whose stamps differ by more are never put together.");
    p.number("cluster_spacing", cluster_spacing, {0.0, 10.0}, "s", When::kStart,
             "Stamps of clusters are never closer than this: tells early that no better partner can come. "
             "About 0.8 / rate.");
    p.number("detection_spacing", detection_spacing, {0.0, 10.0}, "s", When::kStart,
             "Stamps of detections are never closer than this. About 0.8 / rate of the images.");
    p.number("partner_timeout", partner_timeout, {0.0, 3600.0}, "s", When::kLive,
             "How long clusters wait for detections before they go on alone, and how long the camera may be "
             "silent before they wait no more (wall time). Above the latency of the detector.");
    p.number("queue_size", queue_size, {10, 1000}, "messages", When::kStart,
             "Messages of each input that may wait for a partner.");
  }
};

struct MatchParams {
  MatchMethod method = MatchMethod::kPaper;
  ToleranceParams tolerance;
  ObstacleParams obstacle;
  SyncParams sync;

  void declare(Params& p) {
    p.choice(
        "method", method, {"paper"}, When::kStart,
        "How clusters and detections are put together. paper: tolerances on range and azimuth (paper 001).");
    tolerance.declare(p);
    obstacle.declare(p);
    sync.declare(p);
  }
};

/// Keeps its buffers from call to call; the results stay valid until the next call.
class Matcher {
 public:
  explicit Matcher(const MatchParams& params = {}) { setParams(params); }
  void setParams(const MatchParams& params);

  /// First one obstacle for each cluster, then one for each camera target without cluster, both in their
  /// order.
  const std::vector<Obstacle>& run(const std::vector<Cluster>& clusters,
                                   const std::vector<CameraTarget>& targets);

  /// One obstacle for each cluster, all kNoPartnerMessage.
  const std::vector<Obstacle>& runAlone(const std::vector<Cluster>& clusters);

 private:
  ObstacleParams params_;
  ToleranceMatcher tolerance_;
  std::vector<Polar> lidar_, camera_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace field_fusion::core
