#pragma once
// OpenVINO lives in a library of its own that is opened at run time: where it is missing, all else works.
#include <memory>

#include "field_fusion/core/detect/inference.h"

namespace field_fusion::core {

/// Throws std::runtime_error that names the library that is missing, or what OpenVINO says of the model.
std::unique_ptr<Inference> loadOpenVino(const std::string& library, const OnnxFile& model, int threads);

/// The one function of that library, which has C linkage under kOpenVinoFactory. Throws as above.
using OpenVinoFactory = Inference*(const OnnxFile& model, int threads);
constexpr char kOpenVinoFactory[] = "fieldFusionOpenVinoInference";

}  // namespace field_fusion::core
