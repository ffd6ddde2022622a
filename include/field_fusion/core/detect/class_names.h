#pragma once
// The names of a model's classes, by channel.
#include <string>
#include <vector>

#include "field_fusion/core/detect/onnx_file.h"

namespace field_fusion::core {

/// From the entry `names` that Ultralytics writes into the file: {0: 'person', 1: 'bicycle'}.
/// std::runtime_error where there is none, or it does not name all of `classes`.
std::vector<std::string> classNamesOf(const OnnxFile& model, int classes);

/// From a file: *.yaml or *.yml with a list or a dictionary under `names` (an Ultralytics data set),
/// any other has one name a line. std::runtime_error where it cannot be read or its count is not `classes`.
std::vector<std::string> readClassNames(const std::string& path, int classes);

/// The first name by which the model file itself contradicts `names`, for a human; empty where it agrees or has none.
std::string contradictionOf(const OnnxFile& model, const std::vector<std::string>& names);

}  // namespace field_fusion::core
