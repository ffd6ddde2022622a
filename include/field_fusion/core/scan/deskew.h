#pragma once
// Stage `deskew_scan`: every beam of a scan as if all had been measured at one instant (paper 004, MDR).
#include <vector>

#include "field_fusion/core/base/motion_track.h"
#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

/// What became of the beams of one scan.
struct DeskewCounts {
  std::size_t returns = 0;  ///< beams with a range: as many points
  std::size_t unseen = 0;   ///< bins that no beam fell into
};

/// Carries each return by the motion of the scanner since the instant (Eq. 3) and puts it where it then is
/// (Eq. 4, with the usual order of the arctangent). Keeps its buffers from scan to scan.
class ScanDeskewer {
 public:
  /// `scan` without fault; beam i is measured `begin` + i * `time_increment` [s] after the stamp of `track`.
  /// `binned`: in the plane of the scanner at the instant, all the way round, the nearest of each bin; a
  /// return may lie nearer than the scanner can see, so range_min is 0. A beam that met nothing leaves its
  /// bin free. `points`: every return in full, also what left the plane, in the order of the beams; their
  /// time is 0.
  DeskewCounts run(const Scan& scan, double begin, double time_increment, MotionTrack& track, Scan& binned,
                   Cloud& points);

 private:
  void updateDirections(const Scan& scan);

  double angle_min_ = 0.0, angle_increment_ = 0.0;  // of directions_
  std::vector<Eigen::Vector3f> directions_;
};

/// The returns of a scan as they are; the time is each beam's own, [s] after the stamp.
void scanPoints(const Scan& scan, double begin, double time_increment, Cloud& points);

}  // namespace field_fusion::core
