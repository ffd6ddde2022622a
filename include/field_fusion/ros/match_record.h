#pragma once
// What the match stage tells about times in /diagnostics.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <deque>
#include <string>
#include <vector>

#include "field_fusion/core/base/histogram.h"
#include "field_fusion/core/match/sync.h"

namespace field_fusion {

class MatchRecord {
 public:
  explicit MatchRecord(const core::SyncParams& params) : params_(params) { reset(); }

  /// `now` [s] by the clock of the stamps, as the frame goes out.
  void add(const core::Sync::Frame& frame, double now);

  /// Counts and histograms, and a warning where the offset of a camera, the median of the last few, is more
  /// than half of max_interval: a clock is off, or a rate is too low.
  void describe(const core::Sync::Counts& counts, diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  struct Camera {
    std::string name;
    core::Histogram offsets;
    std::deque<double> last;  // [s]
  };
  const core::SyncParams& params_;
  std::vector<Camera> cameras_;
  core::Histogram ages_{0.0, 0.02, 50};
};

}  // namespace field_fusion
