#include "field_fusion/core/base/pose_history.h"

#include <stdexcept>
#include <string>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core {

TimedPose interpolate(const TimedPose& a, const TimedPose& b, double share) {
  return {a.time + share * (b.time - a.time), a.position + share * (b.position - a.position),
          a.rotation.slerp(share, b.rotation)};
}

PoseHistory::PoseHistory(const PoseHistoryParams& params, std::size_t capacity)
    : params_(checked(params)), ring_(capacity) {
  if (capacity < 2) throw std::invalid_argument("a pose history needs room for two poses");
}

void PoseHistory::setParams(const PoseHistoryParams& params) { params_ = checked(params); }

bool PoseHistory::add(const TimedPose& pose) {
  if (!std::isfinite(pose.time) || !pose.position.allFinite() || !pose.rotation.coeffs().allFinite())
    throw std::runtime_error("pose damaged: a number is not finite");
  const double length = pose.rotation.norm();
  if (std::abs(length - 1.0) > 1e-3)
    throw std::runtime_error("pose damaged: a quaternion of length " + std::to_string(length));
  if (count_ > 0 && pose.time <= (*this)[count_ - 1].time) return false;
  ring_[next_] = pose;
  ring_[next_].rotation.normalize();
  next_ = (next_ + 1) % ring_.size();
  if (count_ < ring_.size()) ++count_;
  return true;
}

std::size_t PoseHistory::firstAfter(double time) const {
  std::size_t low = 0, high = count_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if ((*this)[middle].time > time)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

PoseHistory::Cover PoseHistory::cover(double begin, double end) const {
  if (count_ > 0 && (*this)[0].time > begin) return Cover::kBegun;
  if (count_ == 0 || (*this)[count_ - 1].time < end) return Cover::kNotYet;
  constexpr double kSlack = 0.1;  // [m], [rad]: noise of two poses that lie close in time
  for (std::size_t i = firstAfter(begin); i < count_; ++i) {
    const TimedPose &a = (*this)[i - 1], &b = (*this)[i];
    if (a.time >= end) break;
    const double span = b.time - a.time;
    if (span > params_.max_gap) return Cover::kGap;
    if ((b.position - a.position).norm() > params_.max_speed * span + kSlack ||
        a.rotation.angularDistance(b.rotation) > radians(params_.max_turn_rate) * span + kSlack)
      return Cover::kLeap;
  }
  return Cover::kWhole;
}

TimedPose PoseHistory::at(double time) const {
  if (count_ == 0 || !(time >= (*this)[0].time && time <= (*this)[count_ - 1].time))
    throw std::out_of_range("no pose known at " + std::to_string(time) + " s");
  const std::size_t after = firstAfter(time);
  const TimedPose& a = (*this)[after - 1];
  if (after == count_) return a;
  const TimedPose& b = (*this)[after];
  return interpolate(a, b, (time - a.time) / (b.time - a.time));
}

const char* describe(PoseHistory::Cover cover) {
  switch (cover) {
    case PoseHistory::Cover::kWhole:
      return "known throughout";
    case PoseHistory::Cover::kNotYet:
      return "ends too early";
    case PoseHistory::Cover::kBegun:
      return "begins too late";
    case PoseHistory::Cover::kGap:
      return "has a gap above max_gap";
    case PoseHistory::Cover::kLeap:
      return "leaps faster than max_speed or max_turn_rate";
  }
  return "";
}

}  // namespace field_fusion::core
