#pragma once
// Stage `deskew_cloud`: every point of a cloud as if all had been measured at one instant (paper 004, MDR).
#include "field_fusion/core/base/motion_track.h"

namespace field_fusion::core {

/// When the points of a cloud were measured: from the stamp or the first, whichever is earlier, to the stamp
/// or the last. Not known where no point has a time.
struct CloudSweep {
  Sweep sweep;
  std::size_t untimed = 0;  ///< points whose time is not known
  bool known = false;
};
CloudSweep sweepOf(const Cloud& cloud);

/// Carries each point by the motion of the sensor since the instant (Eq. 3); its time is 0 then. A point
/// whose time is not known stays as it is, and so does its time. `out` is not `cloud` itself; the order
/// stays.
void deskew(const Cloud& cloud, MotionTrack& track, Cloud& out);

}  // namespace field_fusion::core
