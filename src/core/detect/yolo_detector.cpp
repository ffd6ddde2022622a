#include "field_fusion/core/detect/yolo_detector.h"

#include <stdexcept>

#include "field_fusion/core/detect/class_names.h"

namespace field_fusion::core {
namespace {

YoloHead headOf(const OnnxFile& model, const Inference& network) {
  try {
    return yoloHead(network.outputShapes(), network.inputSize());
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error("model '" + model.path + "': " + fault.what());
  }
}

}  // namespace

YoloDetector::YoloDetector(const OnnxFile& model, const std::string& class_file)
    : network_(makeInference(model)), letterbox_(network_->inputSize()), decoder_(headOf(model, *network_)) {
  const int classes = decoder_.head().classes;
  class_names_ = class_file.empty() ? classNamesOf(model, classes) : readClassNames(class_file, classes);
}

const Detections& YoloDetector::detect(const cv::Mat& image, PixelOrder order, const YoloParams& params) {
  const std::vector<cv::Mat>& outputs = network_->run(letterbox_.apply(image, order));
  return decoder_.decode(outputs, letterbox_.fit(), params);
}

}  // namespace field_fusion::core
