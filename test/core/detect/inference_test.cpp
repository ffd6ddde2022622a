#include "field_fusion/core/detect/inference.h"

#include <filesystem>

#include <opencv2/core.hpp>

#include "field_fusion/core/detect/yolo_detector.h"
#include "support/detect_fixtures.h"

namespace field_fusion::core {
namespace {

OnnxFile fixture(const std::string& name) { return readOnnxFile(detectFixture(name)); }

TEST(LoadNetwork, FallsBackToOpenCvAndSaysWhy) {
  const auto loaded = loadNetwork(fixture("stock_head.onnx"), {}, "/nowhere/libopenvino.so");
  EXPECT_EQ(
      loaded.backend.find("OpenCV " CV_VERSION " (not OpenVINO: '/nowhere/libopenvino.so' was not built"), 0u)
      << loaded.backend;
  EXPECT_EQ(loaded.output_shapes, (std::vector<std::vector<int>>{{1, 6, 21}}));
}

TEST(LoadNetwork, FallsBackFromALibraryThatCannotBeOpened) {
  const auto library = detectTempFile("libbroken.so", "no library");
  EXPECT_TRUE(test::says(loadNetwork(fixture("stock_head.onnx"), {}, library).backend,
                         "OpenVINO cannot be loaded: " + library));
}

TEST(LoadNetwork, RefusesABackendThatWasAskedForAndIsMissing) {
  const auto fault = test::faultOf([] {
    loadNetwork(fixture("stock_head.onnx"), {Backend::kOpenVino, 0}, "/nowhere/libopenvino.so");
  });
  EXPECT_TRUE(test::says(fault, "'/nowhere/libopenvino.so' was not built"));
}

TEST(LoadNetwork, TakesOpenCvWhereItIsAskedFor) {
  EXPECT_EQ(loadNetwork(fixture("stock_head.onnx"), {Backend::kOpenCv, 0}).backend, "OpenCV " CV_VERSION);
}

TEST(LoadNetwork, NamesTheNetworkThatNoBackendTakes) {
  const auto fault = test::faultOf([] { loadNetwork(fixture("unknown_operator.onnx"), {}); });
  EXPECT_TRUE(test::says(fault, "unknown_operator.onnx': OpenCV cannot import it"));
}

class OpenVino : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(openVinoLibrary())) GTEST_SKIP() << "built without OpenVINO";
  }
};

TEST_F(OpenVino, FindsWhatOpenCvFinds) {
  for (const char* name : {"stock_head.onnx", "raw_head.onnx"}) {
    YoloDetector ours(fixture(name), "", {Backend::kOpenCv, 1});
    YoloDetector theirs(fixture(name), "", {Backend::kOpenVino, 1});
    EXPECT_EQ(theirs.backend(), "OpenVINO");
    cv::RNG random(7);
    for (int i = 0; i < 10; ++i) {
      const cv::Mat image(48, 64, CV_8UC3, cv::Scalar(random(256), 128 + random(128), 128 + random(128)));
      const auto& expected = ours.detect(image, PixelOrder::kBgr, YoloParams{}).detections;
      const auto& found = theirs.detect(image, PixelOrder::kBgr, YoloParams{}).detections;
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t d = 0; d < found.size(); ++d) {
        EXPECT_EQ(found[d].class_id, expected[d].class_id);
        EXPECT_NEAR(found[d].score, expected[d].score, 1e-4);  // bf16 would be off by more
        EXPECT_NEAR(found[d].box.x_min, expected[d].box.x_min, 1e-3);
        EXPECT_NEAR(found[d].box.y_max, expected[d].box.y_max, 1e-3);
      }
    }
  }
}

TEST_F(OpenVino, IsWhatAutoTakes) {
  EXPECT_EQ(loadNetwork(fixture("stock_head.onnx"), {}).backend, "OpenVINO");
}

TEST_F(OpenVino, SaysWhatItCouldNotImport) {
  const auto fault = test::faultOf([] {
    loadNetwork(fixture("unknown_operator.onnx"), {Backend::kOpenVino, 0});
  });
  EXPECT_TRUE(test::says(fault, "unknown_operator.onnx': OpenVINO cannot import it"));
}

}  // namespace
}  // namespace field_fusion::core
