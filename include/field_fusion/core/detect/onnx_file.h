#pragma once
// What an ONNX file says about itself: its image input and its metadata, read without its weights.
// A backend hides both (OpenCV's does) or reads them only after a long import.
#include <map>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

namespace field_fusion::core {

/// Length of a tensor's dimension that the file leaves open.
constexpr int kOpenDimension = -1;

struct OnnxFile {
  std::string path;                             ///< for messages
  std::string bytes;                            ///< the whole file
  std::map<std::string, std::string> metadata;  ///< ModelProto.metadata_props
  std::vector<int> input_shape;                 ///< of the first graph input; may hold kOpenDimension
  bool input_is_float = false;                  ///< 32 bit
};

/// Throws std::runtime_error that names the file and why: missing, empty, truncated, not ONNX.
OnnxFile readOnnxFile(const std::string& path);

/// The same for bytes in memory. Safe on any bytes.
OnnxFile parseOnnx(std::string bytes, const std::string& path);

/// Width and height of an input 1x3xHxW of float32; any other input throws std::runtime_error with its shape.
cv::Size imageInputSize(const OnnxFile& file);

/// "1x84x8400"; an open dimension is "?".
std::string shapeText(const std::vector<int>& shape);

}  // namespace field_fusion::core
