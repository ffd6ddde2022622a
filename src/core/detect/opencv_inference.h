#pragma once
#include <memory>

#include "field_fusion/core/detect/inference.h"

namespace field_fusion::core {

/// OpenCV's DNN module: always there, on the CPU. `threads` > 0 is set for all of OpenCV in the process.
std::unique_ptr<Inference> makeOpenCvInference(const OnnxFile& model, int threads);

}  // namespace field_fusion::core
