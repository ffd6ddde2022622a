#pragma once
// What is written beside an obstacle, and where.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "field_fusion/Obstacle.h"
#include "field_fusion/ros/marker_style.h"

namespace field_fusion {

/// Class and confidence where known, then range and azimuth: "car 0.91\n7.92 m, +1.2 deg".
std::string labelText(const Obstacle& obstacle);

struct Label {
  std::string text;
  Layer layer = Layer::kLabel;
  double letter = 0.5;                              ///< [m] height of a letter
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< [m] in: top of what it belongs to; out: its middle
};

/// [m] Where the view of rviz/usv.rviz looks from: behind and above the sensor.
inline const Eigen::Vector3d kEye(-10.0, 0.0, 8.0);

/// Moves each label up until its text covers neither what it belongs to nor, seen from kEye, a label nearer
/// by.
void layOut(std::vector<Label>& labels);

}  // namespace field_fusion
