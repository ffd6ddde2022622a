#pragma once
// Fits an image into a network's input without changing its shape, and boxes back into the image.
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/detect/image_box.h"

namespace field_fusion::core {

/// Channel order of a colour image.
enum class PixelOrder { kBgr, kRgb };

/// Where the scaled image lies in the input.
struct LetterboxFit {
  cv::Size image;         ///< [px] as received
  cv::Size scaled;        ///< [px] of the input
  int left = 0, top = 0;  ///< [px] padding before the scaled image

  /// Pixels of the input for one pixel of the image; the two axes differ by their rounding only.
  double scale() const;
  ImageBox toImage(const ImageBox& in_input) const;
  ImageBox toInput(const ImageBox& in_image) const;
};

/// Largest size that fits, rounded half to even, the odd pixel of padding behind the image: what
/// networks trained by Ultralytics have seen. Both sizes must be positive.
LetterboxFit letterboxFit(cv::Size image, cv::Size input);

/// Makes the input tensor in a buffer that is kept from call to call.
class Letterbox {
 public:
  explicit Letterbox(cv::Size input);

  /// The image as float32 1x3xHxW, RGB, 0..1, padded with grey; holds until the next call.
  /// Takes 8-bit images of 3 channels, or of 1 (mono: `order` has no meaning). std::invalid_argument
  /// for any other.
  const cv::Mat& apply(const cv::Mat& image, PixelOrder order);

  /// Of the last image.
  const LetterboxFit& fit() const { return fit_; }

 private:
  cv::Mat plane(int channel);

  cv::Size input_;
  LetterboxFit fit_;
  cv::Mat tensor_, scaled_;
  std::vector<cv::Mat> channels_;
};

}  // namespace field_fusion::core
