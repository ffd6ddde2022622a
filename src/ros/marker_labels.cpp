#include "field_fusion/ros/marker_labels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "field_fusion/core/base/types.h"

namespace field_fusion {
namespace {

constexpr double kLetterAspect = 0.55;  // mean width of a letter over its height
constexpr double kLinePitch = 1.3;      // distance of lines over the height of a letter

constexpr std::size_t kLongestName = 40;

std::string text(const char* format, double number) {
  char out[64];
  std::snprintf(out, sizeof out, format, number);
  return out;
}

struct TextSize {
  double width, height;  // [m]
};

TextSize sizeOf(const Label& label) {
  std::size_t lines = 0, widest = 0;
  for (std::size_t begin = 0; begin <= label.text.size(); ++lines) {
    const auto end = std::min(label.text.find('\n', begin), label.text.size());
    widest = std::max(widest, end - begin);
    begin = end + 1;
  }
  return {kLetterAspect * label.letter * static_cast<double>(widest),
          kLinePitch * label.letter * static_cast<double>(lines)};
}

/// What a label covers, seen from kEye: azimuth [rad] and the tangent of the elevation.
struct Cover {
  double azimuth, half_width, low, high;
};

double flatDistance(const Label& label) { return std::max((label.place - kEye).head<2>().norm(), 1.0); }

Cover coverOf(const Label& label) {
  const TextSize size = sizeOf(label);
  const Eigen::Vector3d from_eye = label.place - kEye;
  const double flat = flatDistance(label);
  return {std::atan2(from_eye.y(), from_eye.x()), std::atan(0.5 * size.width / flat),
          (from_eye.z() - 0.5 * size.height) / flat, (from_eye.z() + 0.5 * size.height) / flat};
}

bool overlap(const Cover& a, const Cover& b) {
  return std::abs(core::angleDifference(a.azimuth, b.azimuth)) < a.half_width + b.half_width &&
         a.low < b.high && b.low < a.high;
}

}  // namespace

std::string labelText(const Obstacle& obstacle) {
  std::string out = "range ?";
  if (!std::isnan(obstacle.range)) out = text("%.2f m", obstacle.range);
  out += std::isnan(obstacle.azimuth) ? ", angle ?" : text(", %+.1f deg", core::degrees(obstacle.azimuth));
  if (obstacle.label.empty()) return out;
  return obstacle.label.substr(0, kLongestName) + text(" %.2f\n", obstacle.label_probability) + out;
}

void layOut(std::vector<Label>& labels) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& a, const Label& b) { return flatDistance(a) < flatDistance(b); });
  std::vector<Cover> taken;
  for (Label& label : labels) {
    label.place.z() += 0.5 * sizeOf(label).height + 0.3 * label.letter;
    const double flat = flatDistance(label);
    Cover cover = coverOf(label);
    // a free place is just above one of those taken, and no climb comes back to one left below
    for (std::size_t climb = 0; climb < taken.size(); ++climb) {
      const auto hit =
          std::find_if(taken.begin(), taken.end(), [&](const Cover& c) { return overlap(cover, c); });
      if (hit == taken.end()) break;
      label.place.z() += (hit->high - cover.low) * flat + 1e-6;
      cover = coverOf(label);
    }
    taken.push_back(cover);
  }
}

}  // namespace field_fusion
