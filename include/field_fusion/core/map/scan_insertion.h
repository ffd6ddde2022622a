#pragma once
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/pose2.h"
#include "field_fusion/core/map/slam_scan.h"
#include "field_fusion/core/map/tile_map.h"

namespace field_fusion::core {

/// Writes scans into maps: a hit where a beam ends, a visit in every other cell of its way. Keeps its buffers.
class ScanInsertion {
 public:
  /// `resolution`: [m] of a cell. Tiles that change get `revision`.
  void insert(const SlamScan& scan, const Pose2& T_map_base, double resolution, std::uint64_t revision,
              TileMap& map);

 private:
  struct Changed {
    int x, y;
  };
  class Writer;
  std::vector<Changed> changed_;  // cells whose neighbours' fields are no longer right
};

}  // namespace field_fusion::core
