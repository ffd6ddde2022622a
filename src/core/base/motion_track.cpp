#include "field_fusion/core/base/motion_track.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

constexpr double kKnotAngle = radians(0.5);

int parts(double angle) { return std::max(1, static_cast<int>(std::ceil(angle / kKnotAngle))); }

}  // namespace

Transform keptOn(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate, double time) {
  const double angle = turn_rate.norm() * time;
  Eigen::Matrix3d cross;
  cross << 0, -turn_rate.z(), turn_rate.y(), turn_rate.z(), 0, -turn_rate.x(), -turn_rate.y(), turn_rate.x(),
      0;
  Transform out = Transform::Identity();
  double first = 0.5 * time, second = time / 6.0;  // times `time`: the limits of no turn
  if (std::abs(angle) > 1e-6) {
    out.linear() = Eigen::AngleAxisd(angle, turn_rate.normalized()).toRotationMatrix();
    first = (1.0 - std::cos(angle)) / (angle * angle) * time;
    second = (angle - std::sin(angle)) / (angle * angle * angle) * time;
  }
  const Eigen::Vector3d way = time * velocity;
  out.translation() = way + first * (cross * way) + second * time * (cross * (cross * way));
  return out;
}

void MotionTrack::begin() {
  knots_.clear();
  segment_ = 0;
  time_ = kNaN;
}

void MotionTrack::add(double time, const Transform& T_instant_sensor) {
  Eigen::Quaternionf rotation(Eigen::Quaterniond(T_instant_sensor.linear()).cast<float>());
  if (!knots_.empty() && rotation.dot(knots_.back().rotation) < 0.f) rotation.coeffs() *= -1.f;
  knots_.push_back({static_cast<float>(time), rotation, T_instant_sensor.translation().cast<float>()});
}

void MotionTrack::follow(const PoseHistory& history, double stamp, const Sweep& sweep, double instant,
                         const Transform& T_base_sensor) {
  const Transform T_instant_odom = (history.at(stamp + instant).transform() * T_base_sensor).inverse();
  const auto knot = [&](const TimedPose& pose) {
    add(pose.time - stamp, T_instant_odom * pose.transform() * T_base_sensor);
  };
  begin();
  TimedPose last = history.at(stamp + sweep.begin);
  knot(last);
  const TimedPose end = history.at(stamp + sweep.end);
  for (std::size_t i = history.firstAfter(last.time); last.time < end.time; ++i) {
    const TimedPose& next = i < history.size() && history[i].time < end.time ? history[i] : end;
    const int n = parts(last.rotation.angularDistance(next.rotation));
    for (int k = 1; k < n; ++k) knot(interpolate(last, next, static_cast<double>(k) / n));
    knot(last = next);
  }
}

void MotionTrack::keepOn(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate,
                         const Sweep& sweep, double instant) {
  begin();
  const double span = sweep.end - sweep.begin;
  const int n = parts(turn_rate.norm() * span);
  for (int k = 0; k <= n; ++k) {
    const double time = sweep.begin + span * k / n;
    add(time, keptOn(velocity, turn_rate, time - instant));
  }
}

const MotionTrack::Pose& MotionTrack::at(float time) {
  if (time == time_) return pose_;
  time_ = time;
  while (segment_ + 2 < knots_.size() && time > knots_[segment_ + 1].time) ++segment_;
  while (segment_ > 0 && time < knots_[segment_].time) --segment_;
  const Knot &a = knots_[segment_], &b = knots_[std::min(segment_ + 1, knots_.size() - 1)];
  const float span = b.time - a.time;
  const float share = span > 0.f ? std::clamp((time - a.time) / span, 0.f, 1.f) : 0.f;
  const Eigen::Vector4f mix = (1.f - share) * a.rotation.coeffs() + share * b.rotation.coeffs();
  pose_.rotation = Eigen::Quaternionf(mix.normalized()).toRotationMatrix();
  pose_.position = (1.f - share) * a.position + share * b.position;
  return pose_;
}

}  // namespace field_fusion::core
