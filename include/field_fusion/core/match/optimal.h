#pragma once
// Which body and which detection belong together: the likeliest of all assignments.
#include <vector>

#include "field_fusion/core/match/assignment.h"
#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/gate.h"
#include "field_fusion/core/match/lidar_target.h"
#include "field_fusion/core/match/verdict.h"

namespace field_fusion::core {

/// Of all ways to pair what the gate lets through, the one with the least sum of costs, where a body left
/// alone costs as much as the farthest pair. A detection without range is compared by direction alone. Equal
/// sums are decided by ranges and angles, then by place, so that the order of the targets has no say.
///
/// Reasons: a target whose candidates within the gate all went to others is kTaken; any other is judged by
/// its nearest candidate: the largest of the three terms names the reason. Keeps its buffers from call to
/// call.
class OptimalMatcher {
 public:
  void setGate(const Gate& gate) { gate_ = gate; }

  /// The result stays valid until the next call.
  const Verdicts& run(const std::vector<LidarTarget>& bodies, const CameraView& view);

 private:
  struct Best {
    int other = -1;
    Likeness likeness;
  };
  void sortByPlace(const std::vector<LidarTarget>& bodies, const std::vector<CameraTarget>& targets);
  void compareAll(const std::vector<LidarTarget>& bodies, const CameraView& view);
  void judgeAlone(const std::vector<LidarTarget>& bodies, const std::vector<CameraTarget>& targets);
  static void keepNearer(Best& best, int other, const Likeness& likeness);
  static Verdict verdict(const LidarTarget* body, const CameraTarget* target, const Likeness& likeness);

  Gate gate_;
  Assignment assignment_;
  std::vector<int> body_order_, target_order_;  // rows and columns of the assignment
  std::vector<Candidate> candidates_;
  std::vector<Best> best_of_body_, best_of_target_;  // by place
  Verdicts result_;
};

}  // namespace field_fusion::core
