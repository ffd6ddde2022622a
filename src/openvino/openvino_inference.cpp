// The library that core opens at run time (core/detect/openvino_plugin.h).
#include <openvino/openvino.hpp>

#include <algorithm>
#include <stdexcept>

#include "../core/detect/openvino_plugin.h"

namespace field_fusion::core {
namespace {

[[noreturn]] void fail(const std::string& path, const char* action, const std::exception& error) {
  std::string reason = error.what();  // spread over several lines
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw std::runtime_error("model '" + path + "': OpenVINO cannot " + action + " it: " + reason);
}

class OpenVinoInference : public Inference {
 public:
  OpenVinoInference(const OnnxFile& model, int threads) : path_(model.path) {
    try {
      const auto network = runtime_.read_model(model.bytes, ov::Tensor());
      // its own choice would be bf16 on new processors: slower without AMX, and off by up to 8e-3
      ov::AnyMap config{ov::hint::inference_precision(ov::element::f32),
                        ov::hint::performance_mode(ov::hint::PerformanceMode::LATENCY)};
      if (threads > 0) config.insert(ov::inference_num_threads(threads));
      compiled_ = runtime_.compile_model(network, "CPU", config);
      request_ = compiled_.create_infer_request();
    } catch (const std::exception& error) {
      fail(path_, "import", error);
    }
  }

  const std::vector<cv::Mat>& run(const cv::Mat& input) override {
    try {
      // OpenVINO only reads its input, but has no type that says so
      auto* data = const_cast<float*>(input.ptr<float>());
      request_.set_input_tensor(
          ov::Tensor(ov::element::f32, ov::Shape(input.size.p, input.size.p + input.dims), data));
      request_.infer();
      outputs_.clear();
      for (std::size_t i = 0; i < compiled_.outputs().size(); ++i) {
        ov::Tensor tensor = request_.get_output_tensor(i);
        const std::vector<int> shape(tensor.get_shape().begin(), tensor.get_shape().end());
        outputs_.emplace_back(static_cast<int>(shape.size()), shape.data(), CV_32F, tensor.data<float>());
      }
    } catch (const std::exception& error) {
      fail(path_, "run", error);
    }
    return outputs_;
  }

 private:
  std::string path_;
  ov::Core runtime_;
  ov::CompiledModel compiled_;
  ov::InferRequest request_;
  std::vector<cv::Mat> outputs_;
};

}  // namespace
}  // namespace field_fusion::core

extern "C" field_fusion::core::Inference* fieldFusionOpenVinoInference(
    const field_fusion::core::OnnxFile& model, int threads) {
  return new field_fusion::core::OpenVinoInference(model, threads);
}
