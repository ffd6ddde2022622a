#pragma once
// The two layouts in which a YOLOv8 detection network gives its answer, told apart by their shapes.
#include <vector>

#include <opencv2/core/types.hpp>

#include "field_fusion/core/detect/image_box.h"

namespace field_fusion::core {

/// One output tensor: `rows` of numbers, each for all `cells`.
struct YoloMap {
  int output = 0;  ///< place among the network's outputs
  int cells = 0;   ///< anchors
  int width = 0;   ///< cells in a row of the image; raw head only
  int stride = 0;  ///< [px of the input] of one cell; raw head only
};

/// The stock head is what Ultralytics exports: one output 1x(4 + classes)xanchors with rows cx, cy, w, h
/// [px of the input] and the scores 0..1. The raw head is what that is computed from: for each of the strides
/// 8, 16 and 32 an output 1x(64 + classes)xHxW with four distributions over distances (left, top, right,
/// bottom; 16 bins each, before softmax) and the scores before sigmoid.
struct YoloHead {
  int classes = 0;
  bool raw = false;
  std::vector<YoloMap> maps;

  int boxRows() const { return raw ? 64 : 4; }
  int rows() const { return boxRows() + classes; }
};

/// Throws std::runtime_error with all shapes where they are those of neither head.
YoloHead yoloHead(const std::vector<std::vector<int>>& output_shapes, cv::Size input);

/// Box of one cell [px of the input] from the map's data; NaN where its numbers are not finite.
ImageBox boxOf(const YoloHead& head, const YoloMap& map, const float* data, int cell);

}  // namespace field_fusion::core
