#include "field_fusion/core/sim/image_encoding.h"

#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace field_fusion::core::sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes rgb8(const cv::Mat& rgb) {
  Bytes out;
  out.reserve(rgb.total() * 3);
  for (int v = 0; v < rgb.rows; ++v) out.insert(out.end(), rgb.ptr(v), rgb.ptr(v) + 3 * rgb.cols);
  return out;
}

/// BT.601 in 16-bit fixed point; both pixels of a pair share the mean of their colours.
Bytes uyvy(const cv::Mat& rgb) {
  if (rgb.cols % 2 != 0) throw std::invalid_argument("yuv422 needs an even width");
  Bytes out(rgb.total() * 2);
  std::uint8_t* to = out.data();
  constexpr int kHalf = 1 << 15;
  const auto luma = [](int r, int g, int b) {
    return static_cast<std::uint8_t>((16829 * r + 33039 * g + 6416 * b + (16 << 16) + kHalf) >> 16);
  };
  for (int v = 0; v < rgb.rows; ++v)
    for (const std::uint8_t *p = rgb.ptr(v), *end = p + 3 * rgb.cols; p < end; p += 6) {
      const int r = p[0] + p[3], g = p[1] + p[4], b = p[2] + p[5];  // sums: chroma over 17 bits
      *to++ = static_cast<std::uint8_t>((-9714 * r - 19071 * g + 28785 * b + (256 << 16) + 2 * kHalf) >> 17);
      *to++ = luma(p[0], p[1], p[2]);
      *to++ = static_cast<std::uint8_t>((28785 * r - 24104 * g - 4681 * b + (256 << 16) + 2 * kHalf) >> 17);
      *to++ = luma(p[3], p[4], p[5]);
    }
  return out;
}

Bytes jpeg(const cv::Mat& rgb, int quality) {
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  Bytes out;
  if (!cv::imencode(".jpg", bgr, out, {cv::IMWRITE_JPEG_QUALITY, quality}))
    throw std::runtime_error("OpenCV does not write JPEG");
  return out;
}

}  // namespace

Bytes encoded(const cv::Mat& rgb, Encoding encoding, int jpeg_quality) {
  if (rgb.empty() || rgb.type() != CV_8UC3)
    throw std::invalid_argument("a picture to encode must have 3 x 8 bits and not be empty");
  switch (encoding) {
    case Encoding::kYuv422:
      return uyvy(rgb);
    case Encoding::kJpeg:
      return jpeg(rgb, jpeg_quality);
    case Encoding::kRgb8:
      break;
  }
  return rgb8(rgb);
}

}  // namespace field_fusion::core::sim
