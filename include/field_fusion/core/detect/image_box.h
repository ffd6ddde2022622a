#pragma once
// What a detector says about one body in an image, in pixels of that image.
#include <cstdint>

#include <opencv2/core/types.hpp>

namespace field_fusion::core {

/// Axis-aligned box [px]; (0, 0) is the outer corner of the first pixel, x right, y down.
struct ImageBox {
  float x_min = 0, y_min = 0, x_max = 0, y_max = 0;

  float width() const { return x_max - x_min; }
  float height() const { return y_max - y_min; }
  cv::Point2f centre() const { return {0.5f * (x_min + x_max), 0.5f * (y_min + y_max)}; }
};

/// Borders of the image that cut a box, as bits; the values are those of msg/ImageDetection.msg.
enum Cut : std::uint8_t { kCutLeft = 1, kCutTop = 2, kCutRight = 4, kCutBottom = 8 };

struct Detection {
  int class_id = 0;      ///< channel of the model
  float score = 0;       ///< 0..1
  ImageBox box;          ///< inside the image
  std::uint8_t cut = 0;  ///< Cut bits
};

/// Shared area over joint area, 0..1; 0 where neither box has an area.
float intersectionOverUnion(const ImageBox& a, const ImageBox& b);

/// True where box and image share an area; false for NaN.
bool overlaps(const ImageBox& box, cv::Size image);

/// The part of the box inside the image.
ImageBox clip(const ImageBox& box, cv::Size image);

/// Cut bits of the borders that the box reaches to within `margin` px.
std::uint8_t cutBits(const ImageBox& box, cv::Size image, float margin);

}  // namespace field_fusion::core
