#include "field_fusion/core/detect/image_box.h"

#include <algorithm>

namespace field_fusion::core {

float intersectionOverUnion(const ImageBox& a, const ImageBox& b) {
  const float width = std::min(a.x_max, b.x_max) - std::max(a.x_min, b.x_min);
  const float height = std::min(a.y_max, b.y_max) - std::max(a.y_min, b.y_min);
  if (!(width > 0 && height > 0)) return 0;
  const float shared = width * height;
  return shared / (a.width() * a.height() + b.width() * b.height() - shared);
}

bool overlaps(const ImageBox& box, cv::Size image) {
  return box.x_max > 0 && box.y_max > 0 && box.x_min < image.width && box.y_min < image.height;
}

ImageBox clip(const ImageBox& box, cv::Size image) {
  const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
  return {std::clamp(box.x_min, 0.f, width), std::clamp(box.y_min, 0.f, height),
          std::clamp(box.x_max, 0.f, width), std::clamp(box.y_max, 0.f, height)};
}

std::uint8_t cutBits(const ImageBox& box, cv::Size image, float margin) {
  std::uint8_t cut = 0;
  if (box.x_min <= margin) cut |= kCutLeft;
  if (box.y_min <= margin) cut |= kCutTop;
  if (box.x_max >= image.width - margin) cut |= kCutRight;
  if (box.y_max >= image.height - margin) cut |= kCutBottom;
  return cut;
}

}  // namespace field_fusion::core
