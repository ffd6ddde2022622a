#include "field_fusion/core/detect/yolo.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

/// NaN fails every comparison.
bool hasArea(const ImageBox& box) {
  return std::isfinite(box.width() * box.height()) && box.width() > 0 && box.height() > 0;
}

float sigmoid(float x) { return 1.f / (1.f + std::exp(-x)); }

}  // namespace

const Detections& YoloDecoder::decode(const std::vector<cv::Mat>& outputs, const LetterboxFit& fit,
                                      const YoloParams& params) {
  result_.detections.clear();
  result_.invalid = 0;
  result_.input_scale = fit.scale();
  const auto confidence = static_cast<float>(params.confidence);
  for (const YoloMap& map : head_.maps) {
    const float* data = dataOf(map, outputs);
    scanScores(map, data);
    for (int cell = 0; cell < map.cells; ++cell) {
      const float score = head_.raw ? sigmoid(best_[cell]) : best_[cell];
      if (!std::isfinite(total_[cell]) || score > 1.f) {
        ++result_.invalid;
      } else if (score >= confidence) {
        addCandidate(map, data, cell, score, fit);
      }
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

const float* YoloDecoder::dataOf(const YoloMap& map, const std::vector<cv::Mat>& outputs) const {
  const cv::Mat& output = outputs.at(static_cast<std::size_t>(map.output));
  if (output.type() == CV_32F && output.isContinuous() &&
      output.total() == static_cast<std::size_t>(head_.rows()) * map.cells)
    return output.ptr<float>();
  throw std::invalid_argument("model output " + std::to_string(map.output) + " is not the float32 of " +
                              std::to_string(head_.rows()) + " rows of " + std::to_string(map.cells) +
                              " numbers that it was at load");
}

/// Class by class, because the scores of one class lie in a row: 80 x 8400 of them are read once.
void YoloDecoder::scanScores(const YoloMap& map, const float* data) {
  const float* scores = data + static_cast<std::size_t>(head_.boxRows()) * map.cells;
  best_.assign(scores, scores + map.cells);
  total_.assign(scores, scores + map.cells);
  float* best = best_.data();
  float* total = total_.data();
  for (int c = 1; c < head_.classes; ++c) {
    const float* row = scores + static_cast<std::size_t>(c) * map.cells;
    for (int i = 0; i < map.cells; ++i) {
      best[i] = row[i] > best[i] ? row[i] : best[i];
      total[i] += row[i];
    }
  }
}

void YoloDecoder::addCandidate(const YoloMap& map, const float* data, int cell, float score,
                               const LetterboxFit& fit) {
  const ImageBox box = fit.toImage(boxOf(head_, map, data, cell));
  if (!hasArea(box)) {
    ++result_.invalid;
    return;
  }
  if (!overlaps(box, fit.image)) return;  // in the padding: a body that the camera did not see
  const float* scores = data + static_cast<std::size_t>(head_.boxRows()) * map.cells + cell;
  int class_id = 0;
  while (scores[static_cast<std::size_t>(class_id) * map.cells] != best_[cell]) ++class_id;
  result_.detections.push_back({class_id, score, box, 0});
}

}  // namespace field_fusion::core
