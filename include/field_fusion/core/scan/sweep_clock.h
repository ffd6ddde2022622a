#pragma once
// Stage `deskew_scan`: when each beam of a scan was measured, where drivers fill the times wrongly.
#include <optional>
#include <vector>

#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

/// What is believed of a scan's times, and why.
struct SweepTiming {
  enum class Basis {
    kMessage,    ///< the message's own time_increment
    kParameter,  ///< the user's sweep_time
    kInstant,    ///< the message's 0: all beams at one instant, as simulators and cameras have it
    kSpacing     ///< the message's time_increment makes the scan last longer than scans are apart
  };
  Basis basis = Basis::kMessage;
  double time_increment = 0.0;      ///< [s]
  double scan_time = 0.0;           ///< [s] between scans; 0: not known
  bool scan_time_is_wrong = false;  ///< shorter than its beams take, or longer than scans are apart
};

const char* describe(SweepTiming::Basis basis);

/// Knows how far apart scans come: the median of the last 15 spacings, so that neither jitter nor a lost scan
/// misleads.
class SweepClock {
 public:
  /// The timing of a scan without fault; stamps rise. `sweep_time` [s] of a full turn; 0: by the message.
  SweepTiming of(const Scan& scan, double stamp, double sweep_time);
  void reset();

 private:
  std::optional<double> spacing() const;

  std::optional<double> last_;
  std::vector<double> spacings_;  // a ring
  std::size_t next_ = 0;
};

}  // namespace field_fusion::core
