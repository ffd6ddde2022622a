#include "field_fusion/core/cloud/oriented_box.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr std::size_t kSample = 256;
constexpr int kCoarseSteps = 18;  // of a quarter turn: 5 deg
constexpr int kHalvings = 5;      // to 5 / 2^5 = 0.16 deg

const float kQuarter = static_cast<float>(radians(90.0));

struct Span {
  float low, high;
};
Span spanOf(const std::vector<float>& values) {
  Span span{values[0], values[0]};
  for (const float v : values) {
    span.low = std::min(span.low, v);
    span.high = std::max(span.high, v);
  }
  return span;
}

}  // namespace

OrientedBox OrientedBoxFitter::fit(const Point* points, std::size_t count) {
  sample(points, count);
  const float yaw = bestYaw();
  const Eigen::Vector3f along(std::cos(yaw), std::sin(yaw), 0.f), across(-along.y(), along.x(), 0.f);
  const Eigen::Vector3f origin = points[0].position();
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f p = points[i].position() - origin;
    box.extend(Eigen::Vector3f(p.dot(along), p.dot(across), p.z()));
  }
  const Eigen::Vector3f middle = box.center();
  OrientedBox out;
  out.centre = origin + middle.x() * along + middle.y() * across + Eigen::Vector3f(0.f, 0.f, middle.z());
  out.size = box.sizes();
  out.yaw = yaw;
  if (out.size.y() > out.size.x()) {
    std::swap(out.size.x(), out.size.y());
    out.yaw -= kQuarter;
  }
  return out;
}

void OrientedBoxFitter::sample(const Point* points, std::size_t count) {
  const std::size_t step = (count + kSample - 1) / kSample;
  x_.clear(), y_.clear();
  for (std::size_t i = 0; i < count; i += step) {
    x_.push_back(points[i].x - points[0].x);
    y_.push_back(points[i].y - points[0].y);
  }
  u_.resize(x_.size()), v_.resize(x_.size());
}

/// [m] Mean distance to the nearest side of the box turned by `yaw` [rad].
float OrientedBoxFitter::misfit(float yaw) {
  const float c = std::cos(yaw), s = std::sin(yaw);
  const std::size_t n = x_.size();
  for (std::size_t i = 0; i < n; ++i) {
    u_[i] = c * x_[i] + s * y_[i];
    v_[i] = c * y_[i] - s * x_[i];
  }
  const Span u = spanOf(u_), v = spanOf(v_);
  float sum = 0.f;
  for (std::size_t i = 0; i < n; ++i)
    sum += std::min(std::min(u_[i] - u.low, u.high - u_[i]), std::min(v_[i] - v.low, v.high - v_[i]));
  return sum / static_cast<float>(n);
}

/// [rad] in [0, pi / 2): a box looks the same after a quarter turn.
float OrientedBoxFitter::bestYaw() {
  float step = kQuarter / kCoarseSteps, best = 0.f, least = misfit(0.f);
  const auto consider = [&](float yaw) {
    const float value = misfit(yaw);
    if (value < least) least = value, best = yaw;
  };
  for (int i = 1; i < kCoarseSteps; ++i) consider(static_cast<float>(i) * step);
  for (int i = 0; i < kHalvings; ++i) {
    step /= 2.f;
    const float middle = best;
    consider(middle - step);
    consider(middle + step);
  }
  return best < 0.f ? best + kQuarter : std::min(best, std::nextafter(kQuarter, 0.f));
}

}  // namespace field_fusion::core
