#pragma once
// When the board rests, by how its corners move in the pictures.
#include <vector>

#include "field_fusion/core/calib/board.h"

namespace field_fusion::core {

struct Sighting {
  double stamp = 0.0;  ///< [s]
  std::vector<Eigen::Vector2d> corners;  ///< [px]
};

struct RestParams {
  double motion = 0.5;    ///< [px] by which corners of a resting board move at most, root mean square
  double duration = 0.5;  ///< [s] that it rests at least
  double step = 10.0;     ///< [px] by which corners differ from those of the pose before, root mean square
  double gap = 1.0;       ///< [s] between pictures beyond which the board may have been anywhere
};

/// A board at rest: mean corners, and between which stamps.
struct Rest {
  double begin = 0.0, end = 0.0;  ///< [s]
  std::vector<Eigen::Vector2d> corners;
  std::size_t last = 0;  ///< sighting, of `end`
};

/// Sightings in the order of their stamps. Two that show the corners in opposite order are the same.
std::vector<Rest> findRests(const std::vector<Sighting>& sightings, const RestParams& params);

}  // namespace field_fusion::core
