#include "field_fusion/core/detect/inference.h"

#include "opencv_inference.h"

namespace field_fusion::core {

void Inference::probe() {
  const int shape[] = {1, 3, input_size_.height, input_size_.width};
  for (const cv::Mat& output : run(cv::Mat(4, shape, CV_32F, cv::Scalar(0))))
    output_shapes_.emplace_back(output.size.p, output.size.p + output.dims);
}

std::unique_ptr<Inference> makeInference(const OnnxFile& model) { return makeOpenCvInference(model); }

}  // namespace field_fusion::core
