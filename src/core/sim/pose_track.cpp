#include "field_fusion/core/sim/pose_track.h"

#include <algorithm>
#include <stdexcept>

namespace field_fusion::core::sim {

PoseTrack::PoseTrack(const PoseAt& T_world_sensor, double begin, double end) : begin_(begin), end_(end) {
  constexpr double kStep = 1e-3;
  if (!(std::isfinite(begin) && std::isfinite(end) && end >= begin))
    throw std::invalid_argument("a scan cannot last from " + std::to_string(begin) + " to " +
                                std::to_string(end) + " s");
  const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / kStep)));
  step_ = static_cast<float>((end - begin) / steps);
  if (!(step_ > 0.f)) step_ = 1.f;
  for (int i = 0; i <= steps; ++i) {
    const Transform pose = T_world_sensor(begin + (end - begin) * i / steps);
    Eigen::Quaternionf rotation(Eigen::Quaterniond(pose.linear()).normalized().cast<float>());
    if (i > 0 && rotation.dot(poses_.back().rotation) < 0.f) rotation.coeffs() *= -1.f;
    poses_.push_back({rotation, pose.translation().cast<float>()});
  }
}

PoseTrack::Pose PoseTrack::at(float time) const {
  const float place = std::clamp(time / step_, 0.f, static_cast<float>(poses_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), poses_.size() - 2);
  const float share = place - static_cast<float>(i);
  const Pose &a = poses_[i], &b = poses_[i + 1];
  Eigen::Quaternionf rotation((1.f - share) * a.rotation.coeffs() + share * b.rotation.coeffs());
  rotation.normalize();
  return {rotation, (1.f - share) * a.position + share * b.position};
}

}  // namespace field_fusion::core::sim
