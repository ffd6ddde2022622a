#include "field_fusion/core/detect/yolo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

constexpr int kClasses = 3, kAnchors = 21;
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Output for a 32x32 input with nothing in it, and the image of the same size.
class YoloDecode : public testing::Test {
 protected:
  void SetUp() override {
    const int shape[] = {1, 4 + kClasses, kAnchors};
    output_ = cv::Mat(3, shape, CV_32F, cv::Scalar(0));
  }
  void put(int anchor, cv::Rect2f centre_and_size, int class_id, float score) {
    const cv::Rect2f& r = centre_and_size;
    const float box[] = {r.x, r.y, r.width, r.height};
    for (int row = 0; row < 4; ++row) element(row, anchor) = box[row];
    element(4 + class_id, anchor) = score;
  }
  float& element(int row, int anchor) { return output_.ptr<float>()[row * kAnchors + anchor]; }
  const Detections& decode() { return decoder_.decode({output_}, fit_, params_); }

  cv::Mat output_;
  LetterboxFit fit_ = letterboxFit({32, 32}, {32, 32});
  YoloParams params_;
  YoloDecoder decoder_{yoloHead({{1, 4 + kClasses, kAnchors}}, {32, 32})};
};

TEST_F(YoloDecode, FindsNothingInAnEmptyOutput) {
  EXPECT_TRUE(decode().detections.empty());
  EXPECT_EQ(decode().invalid, 0u);
}

TEST_F(YoloDecode, TurnsCentreAndSizeIntoABoxOfTheBestClass) {
  put(20, {10, 12, 4, 6}, 1, 0.5f);
  element(4 + 2, 20) = 0.75f;
  const Detections& found = decode();
  ASSERT_EQ(found.detections.size(), 1u);
  const Detection& d = found.detections[0];
  EXPECT_EQ(d.class_id, 2);
  EXPECT_EQ(d.score, 0.75f);
  EXPECT_EQ(d.box.x_min, 8.f);
  EXPECT_EQ(d.box.y_min, 9.f);
  EXPECT_EQ(d.box.x_max, 12.f);
  EXPECT_EQ(d.box.y_max, 15.f);
  EXPECT_EQ(d.cut, 0);
}

TEST_F(YoloDecode, CarriesBoxesIntoTheImage) {
  fit_ = letterboxFit({128, 64}, {32, 32});  // a quarter of the size, 8 px padding at the top
  put(0, {16, 16, 8, 4}, 0, 0.9f);
  const Detections& found = decode();
  ASSERT_EQ(found.detections.size(), 1u);
  EXPECT_FLOAT_EQ(found.detections[0].box.x_min, 48.f);
  EXPECT_FLOAT_EQ(found.detections[0].box.y_min, 24.f);
  EXPECT_FLOAT_EQ(found.detections[0].box.x_max, 80.f);
  EXPECT_FLOAT_EQ(found.detections[0].box.y_max, 40.f);
  EXPECT_DOUBLE_EQ(found.input_scale, 0.25);
}

TEST_F(YoloDecode, KeepsAScoreExactlyAtTheLimit) {
  params_.confidence = 0.5;
  put(0, {8, 8, 4, 4}, 0, 0.5f);
  put(1, {24, 24, 4, 4}, 0, std::nextafter(0.5f, 0.f));
  EXPECT_EQ(decode().detections.size(), 1u);
}

TEST_F(YoloDecode, CountsScoresThatAreNoProbability) {
  put(0, {8, 8, 4, 4}, 0, kNaN);  // the first class
  put(1, {8, 8, 4, 4}, 2, kNaN);  // the last
  put(2, {8, 8, 4, 4}, 1, kInf);
  put(3, {8, 8, 4, 4}, 1, -kInf);
  put(4, {8, 8, 4, 4}, 1, 3.5f);  // a logit
  element(4, 4) = 0.9f;
  put(5, {24, 24, 4, 4}, 1, 1.0f);
  const Detections& found = decode();
  EXPECT_EQ(found.invalid, 5u);
  ASSERT_EQ(found.detections.size(), 1u);
  EXPECT_EQ(found.detections[0].score, 1.0f);
}

TEST_F(YoloDecode, CountsBoxesThatAreNone) {
  put(0, {kNaN, 8, 4, 4}, 0, 0.9f);
  put(1, {8, 8, 4, kInf}, 0, 0.9f);
  put(2, {8, 8, 0, 4}, 0, 0.9f);
  put(3, {8, 8, 4, -4}, 0, 0.9f);
  put(4, {8, 8, -4, -4}, 0, 0.9f);
  EXPECT_EQ(decode().invalid, 5u);
  EXPECT_TRUE(decode().detections.empty());
}

TEST_F(YoloDecode, ForgetsTheCountOfTheLastImage) {
  put(0, {8, 8, 4, 4}, 0, kNaN);
  EXPECT_EQ(decode().invalid, 1u);
  element(4, 0) = 0;
  EXPECT_EQ(decode().invalid, 0u);
}

TEST_F(YoloDecode, ClipsBoxesAndNamesTheBordersThatCutThem) {
  params_.border_margin = 1.0;
  put(0, {2, 16, 8, 4}, 0, 0.9f);      // -2 .. 6
  put(1, {30, 2, 8, 8}, 0, 0.8f);      // 26 .. 34, -2 .. 6
  put(2, {16, 29, 4, 4}, 0, 0.7f);     // 27 .. 31: exactly the margin away
  put(3, {16, 27.9f, 4, 6}, 1, 0.6f);  // 24.9 .. 30.9: just beyond
  const std::vector<Detection>& found = decode().detections;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].box.x_min, 0.f);
  EXPECT_EQ(found[0].cut, kCutLeft);
  EXPECT_EQ(found[1].box.x_max, 32.f);
  EXPECT_EQ(found[1].box.y_min, 0.f);
  EXPECT_EQ(found[1].cut, kCutTop | kCutRight);
  EXPECT_EQ(found[2].cut, kCutBottom);
  EXPECT_EQ(found[3].cut, 0);
}

TEST_F(YoloDecode, DropsBoxesOutsideTheImage) {
  fit_ = letterboxFit({32, 16}, {32, 32});  // rows 8 .. 24 of the input
  put(0, {16, 4, 8, 8}, 0, 0.9f);           // ends at the image's upper edge
  put(1, {16, 30, 8, 4}, 0, 0.9f);
  put(2, {40, 16, 16, 4}, 0, 0.9f);   // begins at its right edge
  put(3, {16, 4.5f, 8, 8}, 0, 0.9f);  // half a pixel inside
  ASSERT_EQ(decode().detections.size(), 1u);
  EXPECT_EQ(decode().detections[0].box.y_max, 0.5f);
}

TEST_F(YoloDecode, RefusesAnOutputOfAnotherSize) {
  output_ = cv::Mat(7, 20, CV_32F, cv::Scalar(0));
  EXPECT_THROW(decode(), std::invalid_argument);
  output_ = cv::Mat(7, 21, CV_8U, cv::Scalar(0));
  EXPECT_THROW(decode(), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
