#pragma once
// What the match stage tells about times and directions in /diagnostics.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <deque>
#include <string>
#include <vector>

#include "field_fusion/core/base/histogram.h"
#include "field_fusion/core/match/match.h"

namespace field_fusion {

class MatchRecord {
 public:
  /// `params` must outlive this.
  explicit MatchRecord(const core::MatchParams& params) : params_(params) { reset(); }

  /// `now` [s] by the clock of the stamps, as the frame goes out.
  void add(const core::Sync::Frame& frame, double now);
  /// What became of that frame.
  void add(double stamp, const std::vector<core::Obstacle>& obstacles);

  /// Counts and histograms, and a warning where the offset of a camera, the median of the last few, is more
  /// than half of max_interval: a clock is off, or a rate is too low; another where its boxes have shifted
  /// against the clusters: a sensor was moved.
  void describe(const core::Sync::Counts& counts, diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  struct Camera {
    std::string name;
    core::Histogram offsets;
    std::deque<double> last;  // [s]
    core::AlignmentWatch alignment;
  };
  void describeAlignment(const Camera& camera, diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const core::MatchParams& params_;
  std::vector<Camera> cameras_;
  core::Histogram ages_{0.0, 0.02, 50};
};

}  // namespace field_fusion
