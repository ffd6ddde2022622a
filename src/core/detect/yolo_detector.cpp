#include "field_fusion/core/detect/yolo_detector.h"

#include <opencv2/core.hpp>
#include <stdexcept>

#include "field_fusion/core/detect/class_names.h"

namespace field_fusion::core {
namespace {

YoloHead headOf(const OnnxFile& model, const LoadedNetwork& loaded) {
  try {
    return yoloHead(loaded.output_shapes, loaded.input_size);
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error("model '" + model.path + "': " + fault.what());
  }
}

}  // namespace

YoloDetector::YoloDetector(const OnnxFile& model, const std::string& class_file,
                           const InferenceParams& inference)
    : loaded_(loadNetwork(model, inference)),
      letterbox_(loaded_.input_size),
      decoder_(headOf(model, loaded_)) {
  const int classes = decoder_.head().classes;
  class_names_ = class_file.empty() ? classNamesOf(model, classes) : readClassNames(class_file, classes);
  const cv::Mat grey(loaded_.input_size, CV_8UC3, cv::Scalar::all(114));
  for (const cv::Mat& output : loaded_.network->run(letterbox_.apply(grey, PixelOrder::kRgb)))
    if (!cv::checkRange(output))
      throw std::runtime_error("model '" + model.path + "': it answers a grey image with numbers that are not finite");
}

const Detections& YoloDetector::detect(const cv::Mat& image, PixelOrder order, const YoloParams& params) {
  const std::vector<cv::Mat>& outputs = loaded_.network->run(letterbox_.apply(image, order));
  return decoder_.decode(outputs, letterbox_.fit(), params);
}

}  // namespace field_fusion::core
