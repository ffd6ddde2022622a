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

/// Of what is seen, one point at least: what 1 % of the points are nearer than, because single returns before
/// a body are errors. Changes the order of the points.
Eigen::Vector3d nearestOf(std::vector<Point>& seen);

/// From above, the LiDAR tells where the body is (RoundFitter, completed). How low and high it reaches the
/// camera knows better, whose rows lie closer: the edges of the detection's box, where the image border does
/// not cut them. An edge above the camera's level is that of the body's near side, one below of its far side
/// for the upper edge, and the other way round for the lower. The face of a round body is that of the
/// cylinder, which a scanner's rows may all miss where it is a pipe; that of a box is what is seen. Keeps its
/// buffers.
class OutlineFitter {
 public:
  /// `noise` [m]: standard deviation of a range.
  void setParams(const ShapeParams& params, double noise);

  /// Nothing where the size of the class is not known, and for a round body that is larger than its class.
  /// `seen`: the points of the body, at least one; their order is changed.
  std::optional<Outline> run(std::vector<Point>& seen, const CameraTarget& target,
                             const Transform& T_view_lidar);

 private:
  std::optional<Outline> round(const std::vector<Point>& seen, const ClassShape& shape,
                               const CameraTarget& target, const Transform& T_lidar_view);
  Outline box(std::vector<Point>& seen, const ClassShape& shape, const CameraTarget& target,
              const Transform& T_lidar_view);

  ShapeParams params_;
  double noise_ = 0.0;
  RoundFitter round_;
  OrientedBoxFitter box_;
};

}  // namespace field_fusion::core
