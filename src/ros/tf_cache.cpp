#include "field_fusion/ros/tf_cache.h"

#include <tf2_eigen/tf2_eigen.h>

#include <sstream>

namespace field_fusion {

std::shared_ptr<TfCache> TfCache::shared() {
  static std::mutex mutex;
  static std::weak_ptr<TfCache> cache;
  const std::lock_guard<std::mutex> lock(mutex);
  auto shared = cache.lock();
  if (!shared) cache = shared = std::make_shared<TfCache>();
  return shared;
}

core::Transform TfCache::lookup(const std::string& target, const std::string& source,
                                const ros::Time& stamp) const {
  if (target.empty() || source.empty())
    throw std::runtime_error("frame missing: frame_id is empty, so there is no transform");
  if (target == source) return core::Transform::Identity();
  try {
    const auto transform = buffer_.lookupTransform(target, source, stamp);
    const core::Transform T_target_source = tf2::transformToEigen(transform);
    if (T_target_source.matrix().allFinite()) return T_target_source;
    throw std::runtime_error("transform is not finite: " + source + " to " + target);
  } catch (const tf2::TransformException& e) {
    std::ostringstream text;
    text << "no transform: " << source << " to " << target << " at " << stamp << " (" << e.what() << ")";
    throw std::runtime_error(text.str());
  }
}

bool TfCache::has(const std::string& target, const std::string& source, const ros::Time& stamp) const {
  const bool never = target.empty() || source.empty();  // nothing to wait for: lookup says so
  return never || target == source || buffer_.canTransform(target, source, stamp);
}

void TfCache::onTimeJump() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto now = ros::WallTime::now();
  if (!cleared_.isZero() && (now - cleared_).toSec() < 2.0) return;
  cleared_ = now;
  buffer_.clear();
}

}  // namespace field_fusion
