#include "field_fusion/core/map/local_map.h"

namespace field_fusion::core {

void LocalMap::add(const SlamScan& scan, const PathNode* path, double way) {
  scans_.push_back(scan);
  double gone = 0.0;
  std::size_t kept = 0;
  for (const PathNode* node = path; node && gone <= way && kept < kMost; node = node->before.get(), ++kept)
    if (node->before) gone += between(node->before->at.pose, node->at.pose).position().norm();
  while (scans_.size() > kept) scans_.pop_front();
}

Occupancy LocalMap::draw(const PathNode* path, double resolution, double side) {
  TileMap map;
  const PathNode* node = path;
  for (auto scan = scans_.rbegin(); scan != scans_.rend() && node; ++scan, node = node->before.get())
    insertion_.insert(*scan, node->at.pose, resolution, 1, map);
  const Pose2 end = path ? path->at.pose : Pose2();
  return occupancyAbout(map, resolution, end.x, end.y, side);
}

}  // namespace field_fusion::core
