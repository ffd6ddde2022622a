#include "field_fusion/core/detect/yolo.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field_fusion/core/detect/onnx_file.h"

namespace field_fusion::core {
namespace {

constexpr int kBoxRows = 4;

int anchorsOf(cv::Size input) {
  int anchors = 0;
  for (const int stride : {8, 16, 32}) anchors += (input.width / stride) * (input.height / stride);
  return anchors;
}

/// NaN fails every comparison.
bool hasArea(const ImageBox& box) {
  return std::isfinite(box.width() * box.height()) && box.width() > 0 && box.height() > 0;
}

}  // namespace

YoloHead yoloHead(const std::vector<std::vector<int>>& output_shapes, cv::Size input) {
  const int anchors = anchorsOf(input);
  if (output_shapes.size() == 1) {
    const std::vector<int>& s = output_shapes.front();
    if (s.size() == 3 && s[0] == 1 && s[1] > kBoxRows && s[2] == anchors) return {s[1] - kBoxRows, anchors};
  }
  std::string found;
  for (const auto& shape : output_shapes) found += (found.empty() ? "" : ", ") + shapeText(shape);
  throw std::runtime_error(
      "outputs " + (found.empty() ? "none" : found) + ", expected one of 1x(4 + classes)x" +
      std::to_string(anchors) + " for an input of " + std::to_string(input.width) + "x" +
      std::to_string(input.height) + ": not a YOLOv8 detection model as Ultralytics exports it");
}

const Detections& YoloDecoder::decode(const cv::Mat& output, const LetterboxFit& fit,
                                      const YoloParams& params) {
  const auto expected = static_cast<std::size_t>(kBoxRows + head_.classes) * head_.anchors;
  if (output.type() != CV_32F || !output.isContinuous() || output.total() != expected)
    throw std::invalid_argument("model output is not the float32 1x" +
                                std::to_string(kBoxRows + head_.classes) + "x" +
                                std::to_string(head_.anchors) + " it was at load");
  const float* data = output.ptr<float>();
  result_.detections.clear();
  result_.invalid = 0;
  result_.input_scale = fit.scale();
  scanScores(data + static_cast<std::size_t>(kBoxRows) * head_.anchors);
  const auto confidence = static_cast<float>(params.confidence);
  for (int anchor = 0; anchor < head_.anchors; ++anchor) {
    if (!std::isfinite(total_[anchor]) || best_[anchor] > 1.f) {
      ++result_.invalid;
    } else if (best_[anchor] >= confidence) {
      addCandidate(data, anchor, fit);
    }
  }
  suppressOverlaps(result_.detections, params.iou, params.max_detections);
  const auto margin = static_cast<float>(params.border_margin / result_.input_scale);
  for (Detection& detection : result_.detections) {
    detection.box = clip(detection.box, fit.image);
    detection.cut = cutBits(detection.box, fit.image, margin);
  }
  return result_;
}

/// Class by class, because the scores of one class lie in a row: 80 x 8400 of them are read once.
void YoloDecoder::scanScores(const float* scores) {
  best_.assign(scores, scores + head_.anchors);
  total_.assign(scores, scores + head_.anchors);
  float* best = best_.data();
  float* total = total_.data();
  for (int c = 1; c < head_.classes; ++c) {
    const float* row = scores + static_cast<std::size_t>(c) * head_.anchors;
    for (int i = 0; i < head_.anchors; ++i) {
      best[i] = row[i] > best[i] ? row[i] : best[i];
      total[i] += row[i];
    }
  }
}

void YoloDecoder::addCandidate(const float* output, int anchor, const LetterboxFit& fit) {
  const auto row = [&](int r) { return output[static_cast<std::size_t>(r) * head_.anchors + anchor]; };
  const float x = row(0), y = row(1), half_width = 0.5f * row(2), half_height = 0.5f * row(3);
  const ImageBox box = fit.toImage({x - half_width, y - half_height, x + half_width, y + half_height});
  if (!hasArea(box)) {
    ++result_.invalid;
    return;
  }
  if (!overlaps(box, fit.image)) return;  // in the padding: a body that the camera did not see
  int class_id = 0;
  while (row(kBoxRows + class_id) != best_[anchor]) ++class_id;
  result_.detections.push_back({class_id, best_[anchor], box, 0});
}

}  // namespace field_fusion::core
