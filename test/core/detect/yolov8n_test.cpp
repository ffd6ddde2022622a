// The real network on a real image, where FIELD_FUSION_DATA names the recordings.
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "field_fusion/core/detect/yolo_detector.h"
#include "support/detect_fixtures.h"

namespace field_fusion::core {
namespace {

class Yolov8n : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("FIELD_FUSION_DATA");
    if (!data) GTEST_SKIP() << "FIELD_FUSION_DATA is not set";
    if (GetParam() == Backend::kOpenVino && !std::filesystem::exists(openVinoLibrary()))
      GTEST_SKIP() << "built without OpenVINO";
    folder_ = std::string(data) + "/yolov8n_coco/";
  }
  std::string folder_;
};

INSTANTIATE_TEST_SUITE_P(Backends, Yolov8n, testing::Values(Backend::kOpenCv, Backend::kOpenVino));

TEST_P(Yolov8n, ReproducesTheReferenceBoxes) {
  YoloDetector detector(readOnnxFile(folder_ + "yolov8n_deq_fp32.onnx"), "", {GetParam(), 0});
  YoloParams params;
  params.confidence = 0.25;
  params.iou = 0.45;
  const cv::Mat image = cv::imread(folder_ + "bus.jpg");
  const std::vector<Detection>& found = detector.detect(image, PixelOrder::kBgr, params).detections;
  const YAML::Node expected =
      YAML::LoadFile(folder_ + "bus_reference.json")[0]["detections"];  // JSON is YAML
  const std::vector<std::string>& names = detector.classNames();
  ASSERT_EQ(names.size(), 80u);
  EXPECT_EQ(names[9], "traffic light");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const YAML::Node box = expected[i]["box_xyxy"];
    EXPECT_EQ(names.at(found[i].class_id), expected[i]["class_name"].as<std::string>());
    EXPECT_NEAR(found[i].score, expected[i]["score"].as<float>(), 0.005f);
    EXPECT_NEAR(found[i].box.x_min, box[0].as<float>(), 1.f);
    EXPECT_NEAR(found[i].box.y_min, box[1].as<float>(), 1.f);
    EXPECT_NEAR(found[i].box.x_max, box[2].as<float>(), 1.f);
    EXPECT_NEAR(found[i].box.y_max, box[3].as<float>(), 1.f);
  }
}

}  // namespace
}  // namespace field_fusion::core
