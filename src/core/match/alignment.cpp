#include "field_fusion/core/match/alignment.h"

#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

void AlignmentWatch::add(double stamp, const Eigen::Array2d& difference) {
  if (!difference.allFinite()) return;
  const double second = std::floor(stamp);
  if (second != second_) close();
  second_ = second;
  sum_ += difference;
  ++count_;
}

void AlignmentWatch::close() {
  if (count_ == 0) return;
  const Eigen::Array2d mean = sum_ / count_;
  sum_.setZero();
  count_ = 0;
  if (usual_count_ < kUsual) {
    ++usual_count_;
    usual_sum_ += mean;
    usual_squares_ += mean.square();
    return;
  }
  last_.push_back(mean);
  if (last_.size() > kLast) last_.pop_front();
}

std::optional<AlignmentWatch::Drift> AlignmentWatch::drift() const {
  if (last_.size() < kLast) return std::nullopt;
  Drift out;
  out.usual = usual_sum_ / kUsual;
  out.deviation = (usual_squares_ / kUsual - out.usual.square()).max(0.0).sqrt();
  out.now.setZero();
  for (const Eigen::Array2d& mean : last_) out.now += mean / kLast;
  return out;
}

bool AlignmentWatch::isFault(const Drift& drift, const AlignmentParams& params) {
  const Eigen::Array2d limit = (3.0 * drift.deviation).max(radians(params.drift_floor));
  return ((drift.now - drift.usual).abs() > limit).any();
}

}  // namespace field_fusion::core
