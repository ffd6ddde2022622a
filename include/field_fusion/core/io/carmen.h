#pragma once
// Logs in CARMEN's text format: FLASER, ROBOTLASER1, RAWLASER1 and ODOM.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "field_fusion/core/base/pose2.h"
#include "field_fusion/core/scan/scan.h"

namespace field_fusion::core {

struct CarmenScan {
  std::int64_t stamp_ns = 0;
  double angle_min = 0.0, angle_increment = 0.0;  ///< [rad] of the first beam, counter-clockwise from beam to beam
  double max_range = 0.0;                         ///< [m] 0: the log does not say
  std::vector<float> ranges;                      ///< [m]
  Pose2 odometry;                                 ///< of the robot; RAWLASER1 has none: see `readCarmen`
  Pose2 laser;                                    ///< of the scanner, in the frame of `odometry`
};

struct CarmenLog {
  std::vector<CarmenScan> scans;         ///< in the order of the file
  std::vector<StampedPose2> odometry;    ///< lines ODOM
};

/// `unknown_max_range` [m] stands where the log does not say. A range of 0 is one that the log lacks.
Scan scanOf(const CarmenScan& scan, double unknown_max_range);

/// The stamp is the last number of a line's three words at the end, the logger's, or with `sensor_stamps` the
/// first, that of who sent it. A RAWLASER1 line takes the pose of the last ODOM line before it. Lines of other
/// kinds are passed over. Throws std::runtime_error with file, line and fault of the first line that is damaged:
/// too short, no number where one must be, a count of beams that is none.
CarmenLog readCarmen(const std::filesystem::path& file, bool sensor_stamps = true);

/// "12.5" [s] as nanoseconds, no digit lost up to the ninth; false where it is no number that fits.
bool parseStamp(const std::string& text, std::int64_t& stamp_ns);

}  // namespace field_fusion::core
