#pragma once
#include <memory>

#include "field_fusion/core/detect/inference.h"

namespace field_fusion::core {

/// OpenCV's DNN module: always there, on the CPU.
std::unique_ptr<Inference> makeOpenCvInference(const OnnxFile& model);

}  // namespace field_fusion::core
