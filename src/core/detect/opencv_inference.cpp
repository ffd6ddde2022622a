#include "opencv_inference.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/dnn/dnn.hpp>

#include <algorithm>
#include <stdexcept>

namespace field_fusion::core {
namespace {

[[noreturn]] void fail(const std::string& path, const char* action, const cv::Exception& error) {
  std::string reason = error.what();  // names the node; spread over several lines
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw std::runtime_error(
      "model '" + path + "': OpenCV cannot " + action + " it: " + reason +
      " (of stock Ultralytics exports models/prepare_onnx.py mends what OpenCV refuses)");
}

class OpenCvInference : public Inference {
 public:
  OpenCvInference(const OnnxFile& model, int threads) : path_(model.path) {
    if (threads > 0) cv::setNumThreads(threads);
    try {
      net_ = cv::dnn::readNetFromONNX(model.bytes.data(), model.bytes.size());
      output_names_ = net_.getUnconnectedOutLayersNames();
    } catch (const cv::Exception& error) {
      fail(path_, "import", error);
    }
  }

  const std::vector<cv::Mat>& run(const cv::Mat& input) override {
    try {
      net_.setInput(input);
      net_.forward(outputs_, output_names_);
    } catch (const cv::Exception& error) {
      fail(path_, "run", error);
    }
    return outputs_;
  }

 private:
  std::string path_;
  cv::dnn::Net net_;
  std::vector<std::string> output_names_;
  std::vector<cv::Mat> outputs_;
};

}  // namespace

std::unique_ptr<Inference> makeOpenCvInference(const OnnxFile& model, int threads) {
  return std::make_unique<OpenCvInference>(model, threads);
}

}  // namespace field_fusion::core
