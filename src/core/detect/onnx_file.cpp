#include "field_fusion/core/detect/onnx_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "protobuf_reader.h"

namespace field_fusion::core {
namespace {

// Field numbers of onnx.proto3.
enum Model { kIrVersion = 1, kGraph = 7, kOpsetImport = 8, kMetadataProps = 14 };
enum Graph { kGraphInput = 11 };
enum ValueInfo { kType = 2 };
enum Type { kTensorType = 1 };
enum Tensor { kElementType = 1, kShape = 2 };
enum Shape { kDimension = 1 };
enum Dimension { kLength = 1 };
enum Entry { kKey = 1, kValue = 2 };
constexpr std::uint64_t kFloat32 = 1;

constexpr int kLargestSide = 8192;  // px; a corrupt size would otherwise ask for terabytes

/// The last field `number` that holds bytes, as protobuf rules where one is repeated by mistake.
std::string_view subMessage(std::string_view message, std::uint64_t number) {
  std::string_view found;
  for (ProtobufReader field(message); field.next();)
    if (field.isBytes(number)) found = field.bytes();
  return found;
}

int dimension(std::string_view message) {
  int length = kOpenDimension;
  for (ProtobufReader field(message); field.next();) {
    if (!field.isNumber(kLength)) continue;
    if (field.number() > std::numeric_limits<int>::max())
      throw std::runtime_error("an input dimension is out of range");
    length = static_cast<int>(field.number());
  }
  return length;
}

void readInput(std::string_view value_info, OnnxFile& file) {
  const std::string_view tensor = subMessage(subMessage(value_info, kType), kTensorType);
  for (ProtobufReader field(tensor); field.next();) {
    if (field.isNumber(kElementType)) file.input_is_float = field.number() == kFloat32;
    if (!field.isBytes(kShape)) continue;
    for (ProtobufReader shape(field.bytes()); shape.next();)
      if (shape.isBytes(kDimension)) file.input_shape.push_back(dimension(shape.bytes()));
  }
}

/// Only the first input: files of old exporters list the weights behind it.
void readGraph(std::string_view graph, OnnxFile& file) {
  bool found = false;
  for (ProtobufReader field(graph); field.next();) {
    if (found || !field.isBytes(kGraphInput)) continue;
    readInput(field.bytes(), file);
    found = true;
  }
  if (!found) throw std::runtime_error("its graph has no input");
}

void readModel(OnnxFile& file) {
  bool has_version = false, has_opset = false;
  std::string_view graph;
  for (ProtobufReader field(file.bytes); field.next();) {
    has_version |= field.isNumber(kIrVersion);
    has_opset |= field.isBytes(kOpsetImport);
    if (field.isBytes(kGraph)) graph = field.bytes();
    if (field.isBytes(kMetadataProps))
      file.metadata[std::string(subMessage(field.bytes(), kKey))] = subMessage(field.bytes(), kValue);
  }
  if (!has_version || !has_opset || graph.empty())
    throw std::runtime_error("it has no version, operator set or graph");
  readGraph(graph, file);
}

}  // namespace

OnnxFile readOnnxFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw std::runtime_error("model '" + path + "': no such file");
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !stream)
    throw std::runtime_error("model '" + path + "': cannot be read");
  return parseOnnx({std::istreambuf_iterator<char>(stream), {}}, path);
}

OnnxFile parseOnnx(std::string bytes, const std::string& path) {
  OnnxFile file;
  file.path = path;
  file.bytes = std::move(bytes);
  if (file.bytes.empty()) throw std::runtime_error("model '" + path + "': the file is empty");
  try {
    readModel(file);
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error("model '" + path + "' (" + std::to_string(file.bytes.size()) +
                             " bytes) is truncated or not ONNX: " + fault.what());
  }
  return file;
}

cv::Size imageInputSize(const OnnxFile& file) {
  const std::vector<int>& s = file.input_shape;
  const bool fits = s.size() == 4 && s[0] == 1 && s[1] == 3 && s[2] > 0 && s[2] <= kLargestSide && s[3] > 0 &&
                    s[3] <= kLargestSide;
  if (fits && file.input_is_float) return {s[3], s[2]};
  throw std::runtime_error("model '" + file.path + "': input is " +
                           (file.input_is_float ? "float32 " : "not float32, ") + shapeText(s) +
                           ", expected float32 1x3x(height)x(width) of fixed size up to " +
                           std::to_string(kLargestSide));
}

std::string shapeText(const std::vector<int>& shape) {
  std::string text;
  for (const int length : shape)
    text +=
        (text.empty() ? "" : "x") + (length == kOpenDimension ? std::string("?") : std::to_string(length));
  return text.empty() ? "scalar" : text;
}

}  // namespace field_fusion::core
