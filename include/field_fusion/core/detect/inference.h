#pragma once
// Running a network: image tensor in, tensors out. What the tensors mean is not known here.
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/detect/onnx_file.h"

namespace field_fusion::core {

/// kAuto is OpenVINO where it is there and takes the model, else OpenCV, which is always there.
enum class Backend { kAuto, kOpenCv, kOpenVino };

struct InferenceParams {
  Backend backend = Backend::kAuto;
  int threads = 0;

  void declare(Params& p) {
    p.choice("backend", backend, {"auto", "opencv", "openvino"}, When::kStart,
             "What runs the network. auto: openvino where it is installed, else opencv.");
    p.number("threads", threads, {0, 256}, "threads", When::kStart,
             "Threads of the network; 0: one a core. With opencv it holds for all of OpenCV in the process.");
  }
};

/// A network in a backend. Not thread-safe: one caller at a time.
class Inference {
 public:
  virtual ~Inference() = default;

  /// `input`: float32 1x3xHxW of the model's size. The outputs are float32, in the backend's order, and hold
  /// until the next call. Throws std::runtime_error that names model and reason.
  virtual const std::vector<cv::Mat>& run(const cv::Mat& input) = 0;
};

struct LoadedNetwork {
  std::unique_ptr<Inference> network;
  std::string backend;  ///< for people: what runs it, and why not another
  cv::Size input_size;
  std::vector<std::vector<int>>
      output_shapes;  ///< from a run on a black image: a model that cannot run fails
};

/// The file that holds the OpenVINO backend: beside the library or program that holds this code, or one
/// folder above. It need not be there.
std::string openVinoLibrary();

/// Throws std::runtime_error that names the file and what the backend could not import or run, or what is
/// missing of a backend that was asked for by name.
LoadedNetwork loadNetwork(const OnnxFile& model, const InferenceParams& params,
                          const std::string& openvino_library = openVinoLibrary());

}  // namespace field_fusion::core
