#pragma once
// Running a network: image tensor in, tensors out. What the tensors mean is not known here.
#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/detect/onnx_file.h"

namespace field_fusion::core {

/// A loaded network. Not thread-safe: one caller at a time.
class Inference {
 public:
  virtual ~Inference() = default;

  /// `input`: float32 1x3xHxW of inputSize(). The outputs are float32, in the model's order, and hold
  /// until the next call. Throws std::runtime_error that names model and reason.
  virtual const std::vector<cv::Mat>& run(const cv::Mat& input) = 0;

  cv::Size inputSize() const { return input_size_; }
  /// Known from a run on a black image at load.
  const std::vector<std::vector<int>>& outputShapes() const { return output_shapes_; }

 protected:
  explicit Inference(cv::Size input_size) : input_size_(input_size) {}
  /// Every backend calls this last in its making, so that a model that cannot run fails at load.
  void probe();

 private:
  cv::Size input_size_;
  std::vector<std::vector<int>> output_shapes_;
};

/// Throws std::runtime_error that names the file and what the backend could not import or run.
std::unique_ptr<Inference> makeInference(const OnnxFile& model);

}  // namespace field_fusion::core
