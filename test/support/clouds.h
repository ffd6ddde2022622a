#pragma once
// Small clouds for tests; the same seed gives the same cloud.
#include <initializer_list>
#include <random>

#include "field_fusion/core/base/types.h"

namespace field_fusion::test {

inline core::Point at(float x, float y, float z = 0.f) {
  core::Point p;
  p.x = x, p.y = y, p.z = z;
  return p;
}

inline core::Cloud join(std::initializer_list<core::Cloud> clouds) {
  core::Cloud out;
  for (const core::Cloud& cloud : clouds) out.insert(out.end(), cloud.begin(), cloud.end());
  return out;
}

/// n points `step` [m] apart along x, the first at (x, y, z).
inline core::Cloud line(int n, float step, float x = 0.f, float y = 0.f, float z = 0.f) {
  core::Cloud out;
  for (int i = 0; i < n; ++i) out.push_back(at(x + static_cast<float>(i) * step, y, z));
  return out;
}

/// n points drawn evenly from the box between two corners.
inline core::Cloud fillBox(int n, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                           unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.f, 1.f);
  core::Cloud out;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3f u(unit(random), unit(random), unit(random));
    const Eigen::Vector3f p = low + (high - low).cwiseProduct(u);
    out.push_back(at(p.x(), p.y(), p.z()));
  }
  return out;
}

/// n points of the plane z = height + slope * x for |x|, |y| <= 20 m, with Gaussian noise along z.
inline core::Cloud floor(int n, float height, float slope = 0.f, float noise = 0.f, unsigned seed = 1) {
  core::Cloud out = fillBox(n, {-20.f, -20.f, 0.f}, {20.f, 20.f, 0.f}, seed);
  std::mt19937 random(seed + 1);
  std::normal_distribution<float> error(0.f, 1.f);
  for (core::Point& p : out) p.z = height + slope * p.x + noise * error(random);
  return out;
}

}  // namespace field_fusion::test
