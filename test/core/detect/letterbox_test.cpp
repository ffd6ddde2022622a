#include "field_fusion/core/detect/letterbox.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion::core {
namespace {

constexpr float kGrey = 114.f / 255.f;

float at(const cv::Mat& tensor, int channel, int y, int x) {
  const int index[] = {0, channel, y, x};
  return tensor.at<float>(index);
}

// Expected sizes and paddings by hand from scale = min(w / W, h / H).
TEST(LetterboxFit, CentresTheLargestSizeThatFits) {
  const LetterboxFit wide = letterboxFit({1280, 720}, {640, 640});
  EXPECT_EQ(wide.scaled, cv::Size(640, 360));
  EXPECT_EQ(wide.left, 0);
  EXPECT_EQ(wide.top, 140);
  const LetterboxFit tall = letterboxFit({810, 1080}, {640, 640});
  EXPECT_EQ(tall.scaled, cv::Size(480, 640));
  EXPECT_EQ(tall.left, 80);
}

TEST(LetterboxFit, PutsTheOddPixelOfPaddingBehind) {
  const LetterboxFit fit = letterboxFit({1242, 375}, {640, 640});  // 375 * 640 / 1242 = 193.2
  EXPECT_EQ(fit.scaled, cv::Size(640, 193));
  EXPECT_EQ(fit.top, 223);  // of 447
}

TEST(LetterboxFit, KeepsAtLeastOnePixel) {
  EXPECT_EQ(letterboxFit({1, 10000}, {64, 64}).scaled, cv::Size(1, 64));
  EXPECT_EQ(letterboxFit({1, 1}, {64, 32}).scaled, cv::Size(32, 32));
}

TEST(LetterboxFit, CarriesBoxesThereAndBackAtOddSizes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> side(1, 4000);
  for (int i = 0; i < 200; ++i) {
    const cv::Size image(side(random), side(random));
    const LetterboxFit fit = letterboxFit(image, {640, 416});
    const ImageBox whole = fit.toInput({0, 0, float(image.width), float(image.height)});
    EXPECT_NEAR(whole.x_min, fit.left, 1e-3);
    EXPECT_NEAR(whole.x_max, fit.left + fit.scaled.width, 1e-3);
    EXPECT_NEAR(whole.y_max, fit.top + fit.scaled.height, 1e-3);
    const ImageBox back = fit.toImage(whole);
    EXPECT_NEAR(back.x_min, 0, 2e-2);
    EXPECT_NEAR(back.x_max, image.width, 2e-2);
    EXPECT_NEAR(back.y_max, image.height, 2e-2);
  }
}

TEST(Letterbox, PutsRedFirstForEitherOrder) {
  Letterbox letterbox({32, 32});
  const cv::Mat bgr(16, 32, CV_8UC3, cv::Scalar(51, 102, 255));
  for (const PixelOrder order : {PixelOrder::kBgr, PixelOrder::kRgb}) {
    const cv::Mat& tensor = letterbox.apply(bgr, order);
    EXPECT_FLOAT_EQ(at(tensor, order == PixelOrder::kBgr ? 0 : 2, 16, 16), 1.f);
    EXPECT_FLOAT_EQ(at(tensor, 1, 16, 16), 0.4f);
    EXPECT_FLOAT_EQ(at(tensor, order == PixelOrder::kBgr ? 2 : 0, 16, 16), 0.2f);
  }
}

TEST(Letterbox, PadsWithGreyAlsoAfterAnImageOfAnotherSize) {
  Letterbox letterbox({32, 32});
  letterbox.apply(cv::Mat(32, 16, CV_8UC3, cv::Scalar::all(255)), PixelOrder::kBgr);
  const cv::Mat& tensor = letterbox.apply(cv::Mat(16, 32, CV_8UC3, cv::Scalar::all(255)), PixelOrder::kBgr);
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) EXPECT_FLOAT_EQ(at(tensor, c, y, x), y >= 8 && y < 24 ? 1.f : kGrey);
}

TEST(Letterbox, FillsAllChannelsFromMono) {
  Letterbox letterbox({32, 32});
  const cv::Mat& tensor = letterbox.apply(cv::Mat(1, 1, CV_8UC1, cv::Scalar(51)), PixelOrder::kBgr);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(at(tensor, c, 0, 31), 0.2f);
}

TEST(Letterbox, FindsAnEdgeWhereTheFitPutsIt) {
  cv::Mat image(301, 517, CV_8UC1, cv::Scalar(0));
  image.colRange(200, 517) = 255;
  Letterbox letterbox({640, 640});
  const cv::Mat& tensor = letterbox.apply(image, PixelOrder::kBgr);
  float dark = 0;  // of one row: where the edge lies to a fraction of a pixel
  for (int x = 0; x < 640; ++x) dark += 1.f - at(tensor, 0, 320, x);
  const ImageBox edge = letterbox.fit().toImage({dark, 0, dark, 0});
  EXPECT_NEAR(edge.x_min, 200.f, 0.05f);
}

TEST(Letterbox, ReusesItsBuffer) {
  Letterbox letterbox({32, 32});
  const cv::Mat image(20, 30, CV_8UC3, cv::Scalar::all(9));
  const float* first = letterbox.apply(image, PixelOrder::kBgr).ptr<float>();
  EXPECT_EQ(letterbox.apply(image, PixelOrder::kBgr).ptr<float>(), first);
}

TEST(Letterbox, RefusesWhatIsNoImage) {
  Letterbox letterbox({32, 32});
  const auto fault = [&](const cv::Mat& image) -> std::string {
    try {
      letterbox.apply(image, PixelOrder::kBgr);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(fault(cv::Mat()), "image is empty");
  EXPECT_EQ(fault(cv::Mat(8, 8, CV_8UC4)), "image has 4 channels of 8 bits, expected 1 or 3 of 8 bits");
  EXPECT_EQ(fault(cv::Mat(8, 8, CV_16UC1)), "image has 1 channels of 16 bits, expected 1 or 3 of 8 bits");
  EXPECT_EQ(fault(cv::Mat(8, 8, CV_8UC2)), "image has 2 channels of 8 bits, expected 1 or 3 of 8 bits");
}

}  // namespace
}  // namespace field_fusion::core
