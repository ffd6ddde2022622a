#pragma once
// Stage `costmap`: obstacles as points that a planner's costmap marks.
#include <cmath>
#include <vector>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

struct ObstaclePointsParams {
  double min_existence = 0.5;
  double min_height = -100.0;
  double max_height = 100.0;
  bool camera_alone = true;
  double camera_radius = 0.5;

  void declare(Params& p) {
    p.number("min_existence", min_existence, {0.0, 1.0}, "", When::kLive,
             "An obstacle that exists with a smaller probability is left out.");
    p.number("min_height", min_height, {-1000.0, 1000.0}, "m", When::kLive,
             "Lower points are left out; z in the frame of the output.");
    p.number("max_height", max_height, {-1000.0, 1000.0}, "m", When::kLive,
             "Higher points are left out, such as a bridge that the robot passes below.");
    p.flag("camera_alone", camera_alone, When::kLive,
           "Also what the camera alone sees, where its range is known.");
    p.number("camera_radius", camera_radius, {0.0, 10.0}, "m", When::kLive,
             "Radius of a body that the camera alone sees, where its size is not known.");
    p.rule([this] { return min_height < max_height; }, "min_height must be below max_height");
  }
};

/// An obstacle as far as a planner needs to know it.
struct ObstacleBody {
  double existence = 0.0;  ///< 0..1
  IndexRange points;       ///< of the LiDAR; none: the camera alone sees it
  Eigen::Vector3d position =
      Eigen::Vector3d::Constant(kNaN);  ///< [m] of what the camera alone sees; NaN unknown
  double radius = kNaN;                 ///< [m] of what the camera alone sees; NaN unknown
};

/// Appends the LiDAR points of the bodies that exist surely enough, within the band of heights. Points that
/// are not finite are left out.
void appendLidarPoints(const std::vector<ObstacleBody>& bodies, const Cloud& points,
                       const Transform& T_out_lidar, const ObstaclePointsParams& params, Cloud& out);

/// Appends, for each body of known position that the camera alone sees, the half circle of its outline that
/// faces the origin of the output's frame, points no more than `spacing` [m] apart. The body's height is only
/// roughly known: where it lies outside the band of heights, it is put at the nearer end.
void appendCameraPoints(const std::vector<ObstacleBody>& bodies, double spacing, const Transform& T_out_lidar,
                        const ObstaclePointsParams& params, Cloud& out);

}  // namespace field_fusion::core
