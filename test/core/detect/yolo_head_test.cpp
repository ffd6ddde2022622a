// The two heads: told apart by their shapes, and the raw one against a slow, plain decoding.
#include "field_fusion/core/detect/yolo_head.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/yolo.h"
#include "support/faults.h"

namespace field_fusion::core {
namespace {

using Shapes = std::vector<std::vector<int>>;
const cv::Size kInput(96, 64);  // 12x8, 6x4 and 3x2 cells
constexpr int kClasses = 3;

const Shapes& rawShapes() {
  static const Shapes shapes{{1, 64 + kClasses, 8, 12}, {1, 64 + kClasses, 4, 6}, {1, 64 + kClasses, 2, 3}};
  return shapes;
}

std::vector<cv::Mat> tensors(const Shapes& shapes, float value) {
  std::vector<cv::Mat> made;
  for (const auto& shape : shapes)
    made.emplace_back(static_cast<int>(shape.size()), shape.data(), CV_32F, cv::Scalar(value));
  return made;
}

float& element(cv::Mat& map, int row, int y, int x) {
  const int at[] = {0, row, y, x};
  return map.at<float>(at);
}

YoloParams everything() {
  YoloParams params;
  params.iou = 1.0;
  params.max_detections = 10000;
  params.border_margin = 0;
  return params;
}

/// softmax, its mean and sigmoid in double, spelled out.
Detection plainly(cv::Mat& map, int stride, int y, int x) {
  double side[4];
  for (int s = 0; s < 4; ++s) {
    double total = 0, moment = 0;
    for (int i = 0; i < 16; ++i) total += std::exp(double(element(map, 16 * s + i, y, x)));
    for (int i = 0; i < 16; ++i) moment += i * std::exp(double(element(map, 16 * s + i, y, x))) / total;
    side[s] = moment * stride;
  }
  Detection d;
  for (int c = 0; c < kClasses; ++c) {
    const double score = 1 / (1 + std::exp(-double(element(map, 64 + c, y, x))));
    if (score > d.score) d.score = float(score), d.class_id = c;
  }
  const double cx = (x + 0.5) * stride, cy = (y + 0.5) * stride;
  d.box = clip({float(cx - side[0]), float(cy - side[1]), float(cx + side[2]), float(cy + side[3])}, kInput);
  return d;
}

TEST(RawHead, DecodesAsTheTextbookDoes) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal(0, 2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<cv::Mat> maps = tensors(rawShapes(), 0);
    for (cv::Mat& map : maps)
      for (float* v = map.ptr<float>(); v != map.ptr<float>() + map.total(); ++v) *v = normal(random);
    std::vector<Detection> expected;
    for (int m = 0; m < 3; ++m)
      for (int y = 0; y < rawShapes()[m][2]; ++y)
        for (int x = 0; x < rawShapes()[m][3]; ++x) {
          const Detection d = plainly(maps[m], 8 << m, y, x);
          if (d.score >= 0.25f) expected.push_back(d);
        }
    suppressOverlaps(expected, 1.0, 10000);
    YoloDecoder decoder(yoloHead(rawShapes(), kInput));
    const auto& found = decoder.decode(maps, letterboxFit(kInput, kInput), everything()).detections;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].score, expected[i].score, 1e-6);
      EXPECT_NEAR(found[i].box.x_min, expected[i].box.x_min, 1e-3);
      EXPECT_NEAR(found[i].box.y_min, expected[i].box.y_min, 1e-3);
      EXPECT_NEAR(found[i].box.x_max, expected[i].box.x_max, 1e-3);
      EXPECT_NEAR(found[i].box.y_max, expected[i].box.y_max, 1e-3);
    }
  }
}

/// A body in cell (x 2, y 1) of stride 16, 2 cells to the left and top and 1 to the right and bottom.
std::vector<cv::Mat> oneBody(float logit) {
  std::vector<cv::Mat> maps = tensors(rawShapes(), -50);
  const int bins[] = {2, 2, 1, 1};
  for (int side = 0; side < 4; ++side) element(maps[1], 16 * side + bins[side], 1, 2) = 50;
  element(maps[1], 64 + 1, 1, 2) = logit;
  return maps;
}

TEST(RawHead, SaysWhatTheStockHeadOfTheSameNetworkSays) {
  const Shapes stock_shape{{1, 4 + kClasses, 96 + 24 + 6}};
  std::vector<cv::Mat> stock = tensors(stock_shape, 0);
  const int anchor = 96 + 1 * 6 + 2;
  const float row[] = {32, 16, 48, 48, 0, 0.75f, 0};  // box 8..56 x -8..40, class 1
  for (int r = 0; r < 7; ++r) stock[0].ptr<float>()[r * 126 + anchor] = row[r];
  YoloDecoder raw_decoder(yoloHead(rawShapes(), kInput)), stock_decoder(yoloHead(stock_shape, kInput));
  const LetterboxFit fit = letterboxFit({192, 128}, kInput);
  const auto& a = raw_decoder.decode(oneBody(std::log(3.f)), fit, YoloParams{}).detections;
  const auto& b = stock_decoder.decode(stock, fit, YoloParams{}).detections;
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].class_id, 1);
  EXPECT_EQ(b[0].class_id, 1);
  EXPECT_NEAR(a[0].score, b[0].score, 1e-6);
  EXPECT_EQ(a[0].cut, kCutTop);
  EXPECT_EQ(b[0].cut, kCutTop);
  EXPECT_NEAR(a[0].box.x_min, 16, 1e-4);
  EXPECT_NEAR(b[0].box.x_min, 16, 1e-4);
  EXPECT_NEAR(a[0].box.y_max, 80, 1e-4);
  EXPECT_NEAR(b[0].box.y_max, 80, 1e-4);
}

TEST(RawHead, CountsNumbersThatAreNotFinite) {
  YoloDecoder decoder(yoloHead(rawShapes(), kInput));
  const LetterboxFit fit = letterboxFit(kInput, kInput);
  std::vector<cv::Mat> maps = oneBody(5);
  element(maps[1], 3, 1, 2) = kNaN;  // a bin of the candidate
  element(maps[0], 64, 0, 0) = kNaN;
  element(maps[2], 66, 1, 1) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(decoder.decode(maps, fit, YoloParams{}).invalid, 3u);
  EXPECT_TRUE(decoder.decode(maps, fit, YoloParams{}).detections.empty());
  EXPECT_EQ(decoder.decode(oneBody(5), fit, YoloParams{}).invalid, 0u);
}

TEST(RawHead, TakesLargeNumbersWithoutOverflow) {
  std::vector<cv::Mat> maps = oneBody(200);
  for (int bin = 0; bin < 64; ++bin) element(maps[1], bin, 1, 2) = 1000;  // even: 7.5 cells to each side
  YoloDecoder decoder(yoloHead(rawShapes(), kInput));
  const auto& found = decoder.decode(maps, letterboxFit(kInput, kInput), YoloParams{}).detections;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].score, 1.f);
  EXPECT_EQ(found[0].cut, kCutLeft | kCutTop | kCutRight | kCutBottom);
}

TEST(YoloHead, IsToldFromItsShape) {
  const YoloHead stock = yoloHead({{1, 84, 8400}}, {640, 640});  // 80 * 80 + 40 * 40 + 20 * 20
  EXPECT_FALSE(stock.raw);
  EXPECT_EQ(stock.classes, 80);
  EXPECT_EQ(stock.maps.at(0).cells, 8400);
  EXPECT_EQ(yoloHead({{1, 5, 3549}}, {416, 416}).classes, 1);
  const YoloHead raw = yoloHead(rawShapes(), kInput);
  EXPECT_TRUE(raw.raw);
  EXPECT_EQ(raw.classes, kClasses);
}

TEST(YoloHead, TakesRawMapsInAnyOrder) {
  const Shapes shapes{rawShapes()[2], rawShapes()[0], rawShapes()[1]};
  const YoloHead head = yoloHead(shapes, kInput);
  ASSERT_EQ(head.maps.size(), 3u);
  for (const YoloMap& map : head.maps) {
    const auto& shape = shapes.at(map.output);
    EXPECT_EQ(map.width, shape[3]);
    EXPECT_EQ(map.cells, shape[2] * shape[3]);
    EXPECT_EQ(map.stride * map.width, kInput.width);
  }
}

TEST(YoloHead, RefusesOtherShapesAndNamesThem) {
  const std::vector<Shapes> others = {{},
                                      {{1, 8400, 84}},
                                      {{1, 4, 8400}},
                                      {{1, 25200, 85}},
                                      {{1, 300, 6}},
                                      {{2, 84, 8400}},
                                      {{84, 8400}},
                                      {{1, 116, 8400}, {1, 32, 160, 160}},
                                      {{1, 144, 80, 80}, {1, 144, 40, 40}},
                                      {{1, 64, 80, 80}, {1, 64, 40, 40}, {1, 64, 20, 20}},
                                      {{1, 66, 80, 80}, {1, 66, 40, 40}, {1, 67, 20, 20}},
                                      {{1, 144, 80, 80}, {1, 144, 40, 40}, {1, 144, 40, 40}}};
  for (const auto& shapes : others) EXPECT_THROW(yoloHead(shapes, {640, 640}), std::runtime_error);
  const auto fault = test::faultOf([] { yoloHead({{1, 116, 8400}, {1, 32, 160, 160}}, {640, 640}); });
  EXPECT_TRUE(test::says(fault, "outputs 1x116x8400, 1x32x160x160, expected one of 1x(4 + classes)x8400"));
  EXPECT_TRUE(test::says(fault, "or 1x(64 + classes)x80x80, 1x(64 + classes)x40x40, 1x(64 + classes)x20x20"));
}

}  // namespace
}  // namespace field_fusion::core
