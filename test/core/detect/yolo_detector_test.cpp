#include "field_fusion/core/detect/yolo_detector.h"

#include <cmath>

#include "support/detect_fixtures.h"

namespace field_fusion::core {
namespace {

using Names = std::vector<std::string>;

std::string loadFault(const std::string& model, const std::string& class_file = "") {
  return test::faultOf([&] { YoloDetector(readOnnxFile(model), class_file, {Backend::kOpenCv, 0}); });
}

// The fixture's score in class 0 is the mean of red, in class 1 of green; see models/make_fixtures.py.
TEST(YoloDetector, RunsFromImageToBoxes) {
  YoloDetector detector(readOnnxFile(detectFixture("stock_head.onnx")), "");
  EXPECT_EQ(detector.classNames(), (Names{"red", "green"}));
  const cv::Mat image(64, 64, CV_8UC3, cv::Scalar(0, 102, 204));  // blue, green, red
  const Detections& found = detector.detect(image, PixelOrder::kBgr, YoloParams{});
  ASSERT_EQ(found.detections.size(), 2u);
  const Detection &red = found.detections[0], &green = found.detections[1];
  EXPECT_EQ(red.class_id, 0);
  EXPECT_NEAR(red.score, 0.8f, 1e-5f);
  EXPECT_NEAR(red.box.x_min, 16, 1e-3f);  // 16x8 px around (16, 16) in an input of half the size
  EXPECT_NEAR(red.box.y_max, 40, 1e-3f);
  EXPECT_EQ(green.class_id, 1);
  EXPECT_NEAR(green.score, 0.4f, 1e-5f);
}

TEST(YoloDetector, RunsAModelWithARawHead) {
  YoloDetector detector(readOnnxFile(detectFixture("raw_head.onnx")), "");
  const cv::Mat image(64, 64, CV_8UC3, cv::Scalar(0, 153, 204));  // blue, green, red
  const Detections& found = detector.detect(image, PixelOrder::kBgr, YoloParams{});
  ASSERT_EQ(found.detections.size(), 2u);
  const Detection &red = found.detections[0], &green = found.detections[1];
  EXPECT_EQ(red.class_id, 0);
  EXPECT_NEAR(red.score, 1 / (1 + std::exp(-3.0)), 1e-5);
  EXPECT_NEAR(red.box.x_min, 8, 1e-3f);  // (4, 4) to (28, 20) in an input of half the size
  EXPECT_NEAR(red.box.x_max, 56, 1e-3f);
  EXPECT_NEAR(red.box.y_max, 40, 1e-3f);
  EXPECT_EQ(green.class_id, 1);
  EXPECT_NEAR(green.score, 1 / (1 + std::exp(-1.0)), 1e-5);
  EXPECT_EQ(green.cut, kCutLeft | kCutTop | kCutRight | kCutBottom);
}

TEST(YoloDetector, CountsThePaddingAsGrey) {
  YoloDetector detector(readOnnxFile(detectFixture("stock_head.onnx")), "");
  const cv::Mat image(16, 32, CV_8UC3, cv::Scalar(255, 255, 255));
  const Detections& found = detector.detect(image, PixelOrder::kRgb, YoloParams{});
  ASSERT_FALSE(found.detections.empty());
  EXPECT_NEAR(found.detections[0].score, 0.5 + 0.5 * 114 / 255, 1e-5);
}

TEST(YoloDetector, GoesOnAfterAnImageThatItRefused) {
  YoloDetector detector(readOnnxFile(detectFixture("stock_head.onnx")), "");
  EXPECT_THROW(detector.detect(cv::Mat(), PixelOrder::kBgr, YoloParams{}), std::invalid_argument);
  const cv::Mat image(1, 1, CV_8UC3, cv::Scalar::all(255));
  EXPECT_EQ(detector.detect(image, PixelOrder::kBgr, YoloParams{}).detections.size(), 2u);
}

TEST(YoloDetector, TakesNamesFromAFile) {
  const std::string names = detectTempFile("two.txt", "one\ntwo\n");
  YoloDetector detector(readOnnxFile(detectFixture("unnamed_classes.onnx")), names);
  EXPECT_EQ(detector.classNames(), (Names{"one", "two"}));
}

TEST(YoloDetector, NamesTheFaultOfAModelItCannotUse) {
  EXPECT_TRUE(test::says(loadFault(detectFixture("unnamed_classes.onnx")), "does not name its classes"));
  EXPECT_TRUE(test::says(loadFault(detectFixture("stock_head.onnx"), detectTempFile("one.txt", "one\n")),
                         "1 class names, but the model has 2 classes"));
  EXPECT_TRUE(test::says(loadFault(detectFixture("transposed_head.onnx")),
                         "transposed_head.onnx': outputs 1x21x6, expected one of 1x(4 + classes)x21, or "));
  const std::string whole = detectFileBytes(detectFixture("stock_head.onnx"));
  EXPECT_TRUE(
      test::says(loadFault(detectTempFile("half.onnx", whole.substr(0, whole.size() / 2))),
                 "half.onnx' (" + std::to_string(whole.size() / 2) + " bytes) is truncated or not ONNX"));
}

TEST(YoloDetector, SaysWhatOpenCvCouldNotImport) {
  const std::string fault = loadFault(detectFixture("unknown_operator.onnx"));
  EXPECT_TRUE(test::says(fault, "unknown_operator.onnx': OpenCV cannot import it: OpenCV(" CV_VERSION ")"));
  EXPECT_TRUE(test::says(fault, "NoSuchOperator"));
  EXPECT_TRUE(test::says(fault, "models/prepare_onnx.py"));
}

TEST(YoloDetector, RefusesAModelWithoutNodes) {
  const std::string image =
      detectDimension(1) + detectDimension(3) + detectDimension(32) + detectDimension(32);
  EXPECT_TRUE(test::says(loadFault(detectTempFile("hollow.onnx", detectOnnx(image))),
                         "hollow.onnx': OpenCV cannot run it"));
}

TEST(DetectParams, DefaultsAreWithinTheirLimits) {
  DetectParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
}

}  // namespace
}  // namespace field_fusion::core
