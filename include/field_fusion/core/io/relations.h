#pragma once
// The error of a trajectory by relations between its poses (Kuemmerle et al.: On Measuring the Accuracy of SLAM
// Algorithms, Autonomous Robots 2009).
#include <cstdint>
#include <filesystem>
#include <vector>

#include "field_fusion/core/base/pose2.h"

namespace field_fusion::core {

struct Relation {
  std::int64_t from_ns = 0, to_ns = 0;  ///< stamps of two poses
  Pose2 step;                           ///< T_from_to, as it truly is
};

/// Lines "from to x y z roll pitch yaw" [s, m, rad]; lines that begin with # are passed over. Throws
/// std::runtime_error with file, line and fault.
std::vector<Relation> readRelations(const std::filesystem::path& file);

/// Lines "stamp x y yaw" [s, m, rad]; likewise.
std::vector<StampedPose2> readPoses(const std::filesystem::path& file);

struct MeanAndDeviation {
  double mean = kNaN, deviation = kNaN;  ///< NaN where there is nothing
};

struct RelationScore {
  std::vector<double> translation;  ///< [m] error of each relation that has both poses, in the order of the file
  std::vector<double> rotation;     ///< [rad] likewise, at least 0
  std::size_t missing = 0;          ///< relations without a pose at one of their stamps

  MeanAndDeviation absoluteTranslation() const, squaredTranslation() const;
  MeanAndDeviation absoluteRotation() const, squaredRotation() const;
};

/// Poses are found by their stamps, rounded to microseconds; nothing is interpolated, because the clocks of the
/// published logs are not even. Of two poses at one stamp the later one counts.
RelationScore scoreRelations(const std::vector<StampedPose2>& poses, const std::vector<Relation>& relations);

}  // namespace field_fusion::core
