#pragma once
// A small analytic world for a demonstration without recordings: boxes and upright cylinders on a plane.
// Frame: the robot's base, which stands still; x forward, y left, z up, the ground is z = 0.
#include <Eigen/Geometry>

#include <opencv2/core/types.hpp>

#include <string>
#include <vector>

namespace field_fusion::core {

struct Body {
  enum class Shape { kBox, kCylinder };

  std::string label;  ///< COCO class; empty for what a detector does not know
  Shape shape = Shape::kBox;
  Eigen::Vector3d size{1, 1, 1};                    ///< [m] along x, y, z; a cylinder is size.x wide
  Eigen::Vector2d middle{0, 0};                     ///< [m] of its way over the ground
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();  ///< [m] it goes this far to both sides of the middle
  double period = 10.0;                             ///< [s] there and back
  cv::Vec3b colour{128, 128, 128};                  ///< BGR

  /// Where it stands `time` [s] after the start.
  Eigen::AlignedBox3d boxAt(double time) const;
};

using Scene = std::vector<Body>;

/// A quay: two people walk, a car and a truck drive, others stand still.
Scene quayScene();

struct Hit {
  static constexpr int kNothing = -2, kGround = -1;
  double range;         ///< [m] along the ray; infinite for kNothing
  int body = kNothing;  ///< place in the scene
};

/// The first surface along a ray from `origin` in the unit `direction`. A body that holds the origin is not
/// seen.
Hit cast(const Scene& scene, double time, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace field_fusion::core
