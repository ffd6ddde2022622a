#pragma once
// A scan as the grid SLAM takes it: ends of beams in the robot's frame.
#include <Eigen/Core>

#include <vector>

#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

struct ScanHit {
  Eigen::Vector2f end;                               ///< [m]
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< of the wall that it and its neighbours lie on; 0: none
};

struct SlamScan {
  Eigen::Vector2f origin = Eigen::Vector2f::Zero();  ///< [m] of the beams: the sensor's place
  std::vector<ScanHit> hits;                         ///< beams that ended on something
  std::vector<Eigen::Vector2f> free;                 ///< [m] ends of what is known to be free, nothing was hit
};

struct ScanLimits {
  double min_range = 0.0;     ///< [m] shorter ranges are faults or the robot itself
  double usable_range = 8.0;  ///< [m] beyond it, a beam only says that its way is free up to here
  double max_range = 30.0;    ///< [m] ranges from here on say nothing
};

/// Of a sensor mounted in any way: only the parts of its beams in the robot's x-y plane are used. A beam that saw
/// nothing says nothing either, because many a scanner sees no dark wall: its way is not called free.
SlamScan slamScan(const Scan& scan, const Transform& T_base_sensor, const ScanLimits& limits);

}  // namespace field_fusion::core
