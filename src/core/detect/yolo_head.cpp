#include "field_fusion/core/detect/yolo_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "field_fusion/core/detect/onnx_file.h"

namespace field_fusion::core {
namespace {

using Shapes = std::vector<std::vector<int>>;
constexpr std::array<int, 3> kStrides{8, 16, 32};
constexpr int kBins = 16;

int anchorsOf(cv::Size input) {
  int anchors = 0;
  for (const int stride : kStrides) anchors += (input.width / stride) * (input.height / stride);
  return anchors;
}

/// No maps where the shapes are not those of this head.
YoloHead stockHead(const Shapes& shapes, cv::Size input) {
  YoloHead head;
  if (shapes.size() != 1 || shapes[0].size() != 3) return head;
  head.classes = shapes[0][1] - head.boxRows();
  if (shapes[0][0] == 1 && head.classes > 0 && shapes[0][2] == anchorsOf(input))
    head.maps.push_back({0, shapes[0][2], 0, 0});
  return head;
}

/// The same. The outputs may come in any order: backends have their own.
YoloHead rawHead(const Shapes& shapes, cv::Size input) {
  YoloHead head;
  head.raw = true;
  if (shapes.size() != kStrides.size() || shapes[0].size() != 4) return head;
  head.classes = shapes[0][1] - head.boxRows();
  for (const int stride : kStrides) {
    const cv::Size cells(input.width / stride, input.height / stride);
    const auto found =
        std::find(shapes.begin(), shapes.end(), std::vector<int>{1, head.rows(), cells.height, cells.width});
    if (found == shapes.end() || head.classes <= 0 || cells.area() == 0) return {};
    head.maps.push_back({static_cast<int>(found - shapes.begin()), cells.area(), cells.width, stride});
  }
  return head;
}

std::string expectation(cv::Size input) {
  std::string maps;
  for (const int stride : kStrides)
    maps += (maps.empty() ? "" : ", ") + std::string("1x(64 + classes)x") +
            std::to_string(input.height / stride) + "x" + std::to_string(input.width / stride);
  return "expected one of 1x(4 + classes)x" + std::to_string(anchorsOf(input)) + ", or " + maps +
         ", for an input of " + std::to_string(input.width) + "x" + std::to_string(input.height);
}

/// Expected distance [cells] of a distribution whose bins lie `step` numbers apart: the mean of softmax.
float expectedDistance(const float* logits, std::size_t step) {
  float highest = logits[0];
  for (int i = 1; i < kBins; ++i) highest = std::max(highest, logits[i * step]);
  float total = 0, moment = 0;
  for (int i = 0; i < kBins; ++i) {
    const float weight = std::exp(logits[i * step] - highest);  // at most 1: no overflow
    total += weight;
    moment += weight * static_cast<float>(i);
  }
  return moment / total;
}

}  // namespace

YoloHead yoloHead(const Shapes& output_shapes, cv::Size input) {
  YoloHead head = stockHead(output_shapes, input);
  if (head.maps.empty()) head = rawHead(output_shapes, input);
  if (!head.maps.empty()) return head;
  std::string found;
  for (const auto& shape : output_shapes) found += (found.empty() ? "" : ", ") + shapeText(shape);
  throw std::runtime_error("outputs " + (found.empty() ? "none" : found) + ", " + expectation(input) +
                           ": neither a YOLOv8 detection model as Ultralytics exports it nor its raw head");
}

ImageBox boxOf(const YoloHead& head, const YoloMap& map, const float* data, int cell) {
  const auto cells = static_cast<std::size_t>(map.cells);
  const auto row = [&](int r) { return data + r * cells + cell; };
  if (!head.raw) {
    const float x = *row(0), y = *row(1), half_width = 0.5f * *row(2), half_height = 0.5f * *row(3);
    return {x - half_width, y - half_height, x + half_width, y + half_height};
  }
  const auto distance = [&](int side) { return expectedDistance(row(side * kBins), cells); };
  const float x = static_cast<float>(cell % map.width) + 0.5f,
              y = static_cast<float>(cell / map.width) + 0.5f;
  const auto stride = static_cast<float>(map.stride);
  return {stride * (x - distance(0)), stride * (y - distance(1)), stride * (x + distance(2)),
          stride * (y + distance(3))};
}

}  // namespace field_fusion::core
