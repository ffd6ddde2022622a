#include "field_fusion/ros/marker_shapes.h"

#include <algorithm>
#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion {

geometry_msgs::Point pointOf(const Eigen::Vector3d& p) {
  geometry_msgs::Point out;
  out.x = p.x();
  out.y = p.y();
  out.z = p.z();
  return out;
}

void addBox(Points& lines, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  const auto corner = [&](int bits) {
    const Eigen::Vector3d side(bits & 1 ? 0.5 : -0.5, bits & 2 ? 0.5 : -0.5, bits & 4 ? 0.5 : -0.5);
    return pointOf(centre + side.cwiseProduct(size));
  };
  for (int from = 0; from < 8; ++from)
    for (const int axis : {1, 2, 4}) {
      if (from & axis) continue;
      lines.push_back(corner(from));
      lines.push_back(corner(from | axis));
    }
}

void addDashedLine(Points& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dash) {
  constexpr int kMaxDashes = 200;
  const double wanted = ((to - from).norm() / dash + 1.0) / 2.0;
  const int dashes = static_cast<int>(std::clamp(std::round(wanted), 1.0, double(kMaxDashes)));
  const Eigen::Vector3d step = (to - from) / (2 * dashes - 1);
  for (int i = 0; i < dashes; ++i) {
    lines.push_back(pointOf(from + 2 * i * step));
    lines.push_back(pointOf(from + (2 * i + 1) * step));
  }
}

void addDashedCircle(Points& lines, const Eigen::Vector3d& centre, double radius) {
  constexpr int kDashes = 24, kChords = 2;  // chords of a dash
  const auto at = [&](int i) {
    const double angle = core::radians(360.0) * i / (2 * kDashes * kChords);
    return pointOf(centre + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
  };
  for (int dash = 0; dash < kDashes; ++dash)
    for (int chord = 0; chord < kChords; ++chord) {
      lines.push_back(at(2 * kChords * dash + chord));
      lines.push_back(at(2 * kChords * dash + chord + 1));
    }
}

}  // namespace field_fusion
