#include "field_fusion/core/detect/inference.h"

#include <stdexcept>
#include <utility>

#include "opencv_inference.h"
#include "openvino_plugin.h"

namespace field_fusion::core {
namespace {

LoadedNetwork probed(std::unique_ptr<Inference> network, std::string backend, cv::Size input) {
  LoadedNetwork loaded{std::move(network), std::move(backend), input, {}};
  const int shape[] = {1, 3, input.height, input.width};
  for (const cv::Mat& output : loaded.network->run(cv::Mat(4, shape, CV_32F, cv::Scalar(0))))
    loaded.output_shapes.emplace_back(output.size.p, output.size.p + output.dims);
  return loaded;
}

}  // namespace

LoadedNetwork loadNetwork(const OnnxFile& model, const InferenceParams& params,
                          const std::string& openvino_library) {
  const cv::Size input = imageInputSize(model);
  std::string why_not;
  if (params.backend != Backend::kOpenCv) {
    try {
      return probed(loadOpenVino(openvino_library, model, params.threads), "OpenVINO", input);
    } catch (const std::runtime_error& fault) {
      if (params.backend == Backend::kOpenVino) throw;
      why_not = std::string(" (not OpenVINO: ") + fault.what() + ")";
    }
  }
  return probed(makeOpenCvInference(model, params.threads), "OpenCV " CV_VERSION + why_not, input);
}

}  // namespace field_fusion::core
