#pragma once
// What of the bodies a sensor could see, as seen from above; no stage may know it.
#include <set>
#include <utility>
#include <vector>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/depth_camera.h"
#include "field_fusion/core/sim/pose_track.h"
#include "field_fusion/core/sim/scanner2d.h"
#include "field_fusion/core/sim/truth.h"

namespace field_fusion::core::sim {

/// Which first surfaces count. Ground and the robot itself never do.
struct SeenParams {
  double low = -INFINITY, high = INFINITY;    ///< [m] height in the world, both included
  double nearest = 0.0, farthest = INFINITY;  ///< [m] along the ray
};

/// Column and row of cells; that of (0, 0) has its south-western corner in the world's origin.
using SeenCells = std::set<std::pair<int, int>>;

/// Rays of one instant: through every `step`-th pixel of every such row, or one a beam.
std::vector<Ray> raysOf(const DepthCameraParams& camera, const PoseTrack::Pose& pose, int step);
std::vector<Ray> raysOf(const Scanner2dParams& scanner, const PoseTrack::Pose& pose);

/// Adds the cells [m] in which the rays meet what counts, in the caster's window.
void addSeen(const Caster& caster, const std::vector<Ray>& rays, const SeenParams& params, double cell,
             SeenCells& cells);

/// The cells of a slice beside one without a surface: its outline as seen from above.
SeenCells outlineOf(const TruthGrid& slice);

}  // namespace field_fusion::core::sim
