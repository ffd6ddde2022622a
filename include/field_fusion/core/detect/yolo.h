#pragma once
// From the output of a YOLOv8 detection network to detections in the image.
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/detect/image_box.h"
#include "field_fusion/core/detect/letterbox.h"

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

/// Layout of the stock head, one output 1x(4 + classes)xanchors: rows cx, cy, w, h [px of the
/// input], then the classes' scores 0..1.
struct YoloHead {
  int classes = 0, anchors = 0;
};

/// Throws std::runtime_error with the shapes where they are not those of a stock head over strides
/// 8, 16 and 32.
YoloHead yoloHead(const std::vector<std::vector<int>>& output_shapes, cv::Size input);

/// Decodes outputs of one head; keeps its buffers from call to call.
class YoloDecoder {
 public:
  explicit YoloDecoder(const YoloHead& head) : head_(head) {}
  const YoloHead& head() const { return head_; }

  /// `output`: continuous float32 of the head's shape. The result holds until the next call.
  const Detections& decode(const cv::Mat& output, const LetterboxFit& fit, const YoloParams& params);

 private:
  void scanScores(const float* scores);
  void addCandidate(const float* output, int anchor, const LetterboxFit& fit);

  YoloHead head_;
  Detections result_;
  std::vector<float> best_;   // highest score of each anchor
  std::vector<float> total_;  // sum of scores of each anchor: shows a NaN or Inf in any of them
};

/// Greedy non-maximum suppression for each class. In: any order. Out: best first (equal scores by
/// class, then box, so the order of the input has no say), at most `max_detections`.
void suppressOverlaps(std::vector<Detection>& detections, double iou, int max_detections);

}  // namespace field_fusion::core
