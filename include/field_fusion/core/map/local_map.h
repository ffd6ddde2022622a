#pragma once
// The map of the last so many metres of the way alone, for a fusion that counts each piece of evidence once.
#include <deque>

#include "field_fusion/core/map/occupancy.h"
#include "field_fusion/core/map/scan_insertion.h"
#include "field_fusion/core/map/slam_path.h"

namespace field_fusion::core {

class LocalMap {
 public:
  static constexpr std::size_t kMost = 500;  ///< scans: of a robot that stands still only the last count

  /// A scan that was taken in, as the last of `path`; scans from more than `way` [m] before are forgotten.
  void add(const SlamScan& scan, const PathNode* path, double way);
  /// The scans at the poses that `path` now gives them: the best particle may be another. About its end, a square of `side`
  /// [m] of cells of the whole map.
  Occupancy draw(const PathNode* path, double resolution, double side);
  void clear() { scans_.clear(); }

 private:
  std::deque<SlamScan> scans_;  // the newest last
  ScanInsertion insertion_;
};

}  // namespace field_fusion::core
