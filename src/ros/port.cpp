#include "field_fusion/ros/port.h"

#include <limits>

namespace field_fusion {

std::mutex& linkMutex() {
  static std::mutex mutex;
  return mutex;
}

bool FaultLog::add(const std::string& text) {
  constexpr double kLogPeriod = 5.0;  // [s] of wall time
  const auto kind = text.substr(0, text.find(':'));
  const auto now = ros::WallTime::now();
  ++total_;
  ++by_kind_[kind];
  last_ = text;
  last_at_ = now;
  auto& logged = logged_[kind];
  if (!logged.isZero() && (now - logged).toSec() < kLogPeriod) return false;
  logged = now;
  return true;
}

double FaultLog::age() const {
  return total_ == 0 ? std::numeric_limits<double>::infinity() : (ros::WallTime::now() - last_at_).toSec();
}

}  // namespace field_fusion
