#include "field_fusion/core/detect/letterbox.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

constexpr double kPadding = 114.0 / 255.0;  // the grey that networks trained by Ultralytics have seen

int roundHalfEven(double value) { return static_cast<int>(std::nearbyint(value)); }

void requireImage(const cv::Mat& image) {
  if (image.empty()) throw std::invalid_argument("image is empty");
  const bool known =
      image.dims == 2 && image.depth() == CV_8U && (image.channels() == 1 || image.channels() == 3);
  if (known) return;
  throw std::invalid_argument("image has " + std::to_string(image.channels()) + " channels of " +
                              std::to_string(8 * image.elemSize1()) + " bits, expected 1 or 3 of 8 bits");
}

}  // namespace

double LetterboxFit::scale() const {
  return std::min(double(scaled.width) / image.width, double(scaled.height) / image.height);
}

ImageBox LetterboxFit::toImage(const ImageBox& in_input) const {
  const float sx = float(image.width) / scaled.width, sy = float(image.height) / scaled.height;
  return {(in_input.x_min - left) * sx, (in_input.y_min - top) * sy, (in_input.x_max - left) * sx,
          (in_input.y_max - top) * sy};
}

ImageBox LetterboxFit::toInput(const ImageBox& in_image) const {
  const float sx = float(scaled.width) / image.width, sy = float(scaled.height) / image.height;
  return {in_image.x_min * sx + left, in_image.y_min * sy + top, in_image.x_max * sx + left,
          in_image.y_max * sy + top};
}

LetterboxFit letterboxFit(cv::Size image, cv::Size input) {
  const double scale = std::min(double(input.width) / image.width, double(input.height) / image.height);
  LetterboxFit fit;
  fit.image = image;
  fit.scaled.width = std::max(1, roundHalfEven(image.width * scale));
  fit.scaled.height = std::max(1, roundHalfEven(image.height * scale));
  fit.left = (input.width - fit.scaled.width) / 2;
  fit.top = (input.height - fit.scaled.height) / 2;
  return fit;
}

Letterbox::Letterbox(cv::Size input) : input_(input) {
  const int shape[] = {1, 3, input.height, input.width};
  tensor_.create(4, shape, CV_32F);
}

const cv::Mat& Letterbox::apply(const cv::Mat& image, PixelOrder order) {
  requireImage(image);
  if (image.size() != fit_.image) {
    fit_ = letterboxFit(image.size(), input_);
    tensor_.setTo(kPadding);
  }
  cv::resize(image, scaled_, fit_.scaled, 0, 0, cv::INTER_LINEAR);
  cv::split(scaled_, channels_);
  const cv::Rect inside({fit_.left, fit_.top}, fit_.scaled);
  for (int c = 0; c < 3; ++c) {
    const cv::Mat& source = channels_[channels_.size() == 1 ? 0 : order == PixelOrder::kBgr ? 2 - c : c];
    cv::Mat target = plane(c)(inside);
    source.convertTo(target, CV_32F, 1.0 / 255.0);
  }
  return tensor_;
}

cv::Mat Letterbox::plane(int channel) {
  return cv::Mat(input_.height, input_.width, CV_32F, tensor_.ptr<float>(0, channel));
}

}  // namespace field_fusion::core
