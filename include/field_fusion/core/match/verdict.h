#pragma once
// How a target fared when LiDAR and camera were put together.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

/// Why a target was matched or not; the values are those of msg/Obstacle.msg.
enum class MatchReason : std::uint8_t {
  kMatched = 0,
  kNoCandidate = 1,
  kRangeDiffers = 2,
  kAzimuthDiffers = 3,
  kTaken = 4,
  kRangeUnknown = 5,
  kNoBearing = 6,
  kNoPartnerMessage = 7,
  kElevationDiffers = 8
};

/// The differences (paper 001 Eq. 12, here signed: LiDAR minus camera) are those to the partner, or to the
/// best candidate of a target without partner; NaN where one of the two is not known.
struct Verdict {
  int partner = -1;  ///< place of the matched target on the other side
  MatchReason reason = MatchReason::kNoCandidate;
  double range_difference = kNaN;    ///< [m]
  double azimuth_difference = kNaN;  ///< [rad]
  /// To the same target: in standard deviations (Mahalanobis), or in tolerances; NaN where nothing was
  /// comparable.
  double distance = kNaN;
  double elevation_difference = kNaN;  ///< [rad] optimal method only
};

struct Verdicts {
  std::vector<Verdict> lidar, camera;  ///< one for each target
};

}  // namespace field_fusion::core
