#pragma once
// The whole body, from what is seen of it and the size of its class.
#include <optional>

#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/class_shape.h"
#include "field_fusion/core/match/lidar_target.h"
#include "field_fusion/core/match/round_fit.h"

namespace field_fusion::core {

/// An upright cylinder or box in the LiDAR's frame. [m]
struct Outline {
  Eigen::Vector3d centre;
  Eigen::Matrix3d covariance;  ///< [m^2] of the centre
  Eigen::Vector3d size;        ///< axis-aligned extent
  Eigen::Vector3d face;        ///< its point that is nearest to the LiDAR
};

/// From above, the LiDAR tells where the body is (RoundFitter, completed). How low and high it reaches the
/// camera knows better, whose rows lie closer: the edges of the detection's box, where the image border does
/// not cut them. An edge above the camera's level is that of the body's near side, one below of its far side
/// for the upper edge, and the other way round for the lower. Keeps its buffers.
class OutlineFitter {
 public:
  /// `noise` [m]: standard deviation of a range.
  void setParams(const ShapeParams& params, double noise);

  /// Nothing where the size of the class is not known. `seen`: the points of the body, at least one.
  std::optional<Outline> run(const std::vector<Point>& seen, const CameraTarget& target,
                             const Transform& T_view_lidar);

 private:
  ShapeParams params_;
  double noise_ = 0.0;
  RoundFitter round_;
  OrientedBoxFitter box_;
};

}  // namespace field_fusion::core
