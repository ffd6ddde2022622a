#pragma once
// Shapes as the point pairs of a LINE_LIST.
#include <geometry_msgs/Point.h>

#include <Eigen/Core>

#include <vector>

namespace field_fusion {

using Points = std::vector<geometry_msgs::Point>;

geometry_msgs::Point pointOf(const Eigen::Vector3d& p);

/// The twelve edges of an axis-aligned box.
void addBox(Points& lines, const Eigen::Vector3d& centre, const Eigen::Vector3d& size);

/// Dashes of about `dash` [m] with gaps as long; the first and the last end where the line ends.
void addDashedLine(Points& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dash);

/// Parallel to the x-y plane.
void addDashedCircle(Points& lines, const Eigen::Vector3d& centre, double radius);

}  // namespace field_fusion
