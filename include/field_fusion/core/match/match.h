#pragma once
// Clusters and the detections of some cameras of one instant to obstacles.
#include <optional>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/match/alignment.h"
#include "field_fusion/core/match/join.h"
#include "field_fusion/core/match/obstacle.h"
#include "field_fusion/core/match/optimal.h"
#include "field_fusion/core/match/outline.h"
#include "field_fusion/core/match/split.h"
#include "field_fusion/core/match/sync.h"
#include "field_fusion/core/match/tolerance.h"

namespace field_fusion::core {

enum class MatchMethod { kOptimal, kPaper };

struct MatchParams {
  MatchMethod method = MatchMethod::kOptimal;
  GateParams gate;
  SplitParams split;
  ShapeParams shape;
  ToleranceParams tolerance;
  ObstacleParams obstacle;
  AlignmentParams alignment;
  SyncParams sync;
  std::string frame;

  void declare(Params& p) {
    p.choice(
        "method", method, {"optimal", "paper"}, When::kLive,
        "How clusters and detections are put together. optimal: the likeliest assignment by range, azimuth "
        "and elevation. paper: tolerances on range and azimuth (paper 001).");
    gate.declare(p);
    split.declare(p);
    shape.declare(p);
    tolerance.declare(p);
    obstacle.declare(p);
    alignment.declare(p);
    sync.declare(p);
    p.text("frame", frame, When::kStart,
           "Frame of obstacles that the cameras alone see before any cluster has come; then that of the "
           "clusters. Empty: such obstacles are dropped.");
  }
};

/// Keeps its buffers from call to call; the results stay valid until the next call.
class Matcher {
 public:
  explicit Matcher(const MatchParams& params = {}) { setParams(params); }
  void setParams(const MatchParams& params);

  /// First one obstacle for each cluster, for each part of one that was split or for all pieces of one body,
  /// then one for each faint cluster that a camera claims, then those that cameras alone saw, in their order.
  /// `points` are those of all clusters; `views` holds each camera, empty where it has not answered. Where
  /// none has, all are kNoPartnerMessage.
  ///
  /// The paper's method takes clusters as they are and their boxes' centres for the bodies'. `optimal` joins
  /// and splits them by the cameras' boxes, and completes bodies whose class has a known size.
  ///
  /// Each camera is matched on its own. Of several that see a body, the one with the least distance names it;
  /// of several that alone see what may be one body by the gate, the one that knows its place best.
  ///
  /// A detection that found no cluster claims a faint one in its box, in range where the detection has one:
  /// so only optimal, and not by direction alone, for whatever stands behind the box is as near in direction.
  const std::vector<Obstacle>& run(const std::vector<Cluster>& clusters, const std::vector<Point>& points,
                                   const std::vector<std::optional<CameraView>>& views);

 private:
  const Verdicts& judge(const CameraView& view);
  void claimFaint(const std::vector<Cluster>& clusters, const CameraView& view, Verdicts& verdicts);
  void addBodies(const std::vector<Point>& points, const std::vector<std::optional<CameraView>>& views);
  void addCameraOnly(int camera, const CameraView& view, const std::vector<Verdict>& verdicts);

  MatchParams params_;
  Joiner joiner_;
  Splitter splitter_;
  OutlineFitter outline_;
  OptimalMatcher optimal_;
  ToleranceMatcher tolerance_;
  double margin_ = 0.0;  // [rad] by which a box may be off
  std::vector<LidarTarget> bodies_, faint_;
  std::vector<Point> seen_points_;
  CameraView unmatched_;
  std::vector<int> unmatched_place_;  // of each in its camera's view
  std::vector<Polar> lidar_, camera_;
  std::vector<Verdicts> verdicts_;  // of each camera
  std::vector<Obstacle> obstacles_, seen_;
  std::vector<Candidate> candidates_;
  Assignment same_body_;
};

}  // namespace field_fusion::core
