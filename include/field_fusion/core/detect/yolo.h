#pragma once
// From the outputs of a YOLOv8 detection network to detections in the image.
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/detect/letterbox.h"
#include "field_fusion/core/detect/yolo_head.h"

namespace field_fusion::core {

struct YoloParams {
  double confidence = 0.25;
  double iou = 0.45;
  int max_detections = 300;
  double border_margin = 2.0;

  void declare(Params& p) {
    p.number("confidence", confidence, {0.001, 1.0}, "", When::kLive, "Lowest score of a detection.");
    p.number(
        "iou", iou, {0.0, 1.0}, "", When::kLive,
        "Of two boxes of one class that overlap more than this, the one with the lower score is dropped.");
    p.number("max_detections", max_detections, {1, 10000}, "detections", When::kLive,
             "Detections of one image; the best are kept.");
    p.number("border_margin", border_margin, {0.0, 50.0}, "px", When::kLive,
             "A box this close to a border of the image counts as cut by it; pixels of the model's input.");
  }
};

struct Detections {
  std::vector<Detection> detections;  ///< best score first
  std::size_t invalid = 0;            ///< candidates refused: score or box NaN or Inf, score above 1, no area
  double input_scale = 1.0;           ///< pixels of the model's input for one pixel of the image
};

/// Decodes outputs of one head; keeps its buffers from call to call.
class YoloDecoder {
 public:
  explicit YoloDecoder(YoloHead head) : head_(std::move(head)) {}
  const YoloHead& head() const { return head_; }

  /// `outputs`: continuous float32 of the head's shapes. The result holds until the next call.
  const Detections& decode(const std::vector<cv::Mat>& outputs, const LetterboxFit& fit,
                           const YoloParams& params);

 private:
  const float* dataOf(const YoloMap& map, const std::vector<cv::Mat>& outputs) const;
  void scanScores(const YoloMap& map, const float* data);
  void addCandidate(const YoloMap& map, const float* data, int cell, float score, const LetterboxFit& fit);

  YoloHead head_;
  Detections result_;
  std::vector<float> best_;   // highest score of each cell of one map, as the network gives it
  std::vector<float> total_;  // sum of scores of each cell: shows a NaN or Inf in any of them
};

/// Greedy non-maximum suppression for each class. In: any order. Out: best first (equal scores by
/// class, then box, so the order of the input has no say), at most `max_detections`.
void suppressOverlaps(std::vector<Detection>& detections, double iou, int max_detections);

}  // namespace field_fusion::core
