#pragma once
// The whole of a box-shaped body, of which one or two sides are seen.
#include "field_fusion/core/cloud/oriented_box.h"
#include "field_fusion/core/match/class_shape.h"

namespace field_fusion::core {

/// Seen from above.
struct BoxFit {
  Eigen::Vector2d centre;
  Eigen::Vector2d size;  ///< [m] along yaw and across it
  double yaw = 0.0;      ///< [rad]
  Eigen::Matrix2d covariance;
};

/// What is seen (a box turned to fit, in the frame of the sensor), made as large as its class away from the
/// sensor: the near sides stay. The longer seen side is the length or the width of the class, whichever is
/// nearer to it. A side is only made longer where the sensor looks along it enough to see its near end; what
/// is seen larger than its class stays so. `noise` [m] of a range, `spread` of sizes as a share.
BoxFit completed(const OrientedBox& seen, const ClassShape& shape, double spread, double noise);

}  // namespace field_fusion::core
