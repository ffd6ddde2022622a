#include "field_fusion/core/cloud/deskew.h"

#include <algorithm>

namespace field_fusion::core {

CloudSweep sweepOf(const Cloud& cloud) {
  float begin = 0.f, end = 0.f;
  CloudSweep out;
  for (const Point& p : cloud) {
    if (!std::isfinite(p.time)) {
      ++out.untimed;
      continue;
    }
    begin = std::min(begin, p.time);
    end = std::max(end, p.time);
  }
  out.sweep = {begin, end};
  out.known = cloud.empty() || out.untimed < cloud.size();
  return out;
}

void deskew(const Cloud& cloud, MotionTrack& track, Cloud& out) {
  out.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Point& p = out[i] = cloud[i];
    if (!std::isfinite(p.time)) continue;
    const Eigen::Vector3f at = track.at(p.time) * p.position();
    p.x = at.x(), p.y = at.y(), p.z = at.z();
    p.time = 0.f;
  }
}

}  // namespace field_fusion::core
