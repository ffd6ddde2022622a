#pragma once
// Files and bytes for the tests of core/detect.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "support/faults.h"

namespace field_fusion::core {

/// A model of test/fixtures, made by models/make_fixtures.py.
inline std::string detectFixture(const std::string& name) {
  return std::string(PROJECT_DIR "/test/fixtures/") + name;
}

inline std::string detectFileBytes(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

inline std::string detectTempFile(const std::string& name, const std::string& bytes) {
  const std::string path = testing::TempDir() + "detect_" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Protobuf fields, to write models by hand.
inline std::string detectVarint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
  return bytes + static_cast<char>(value);
}
inline std::string detectNumber(std::uint64_t field, std::uint64_t value) {
  return detectVarint(field << 3) + detectVarint(value);
}
inline std::string detectBytes(std::uint64_t field, const std::string& bytes) {
  return detectVarint(field << 3 | 2) + detectVarint(bytes.size()) + bytes;
}

/// The least of an ONNX file: version, graph with one tensor input, operator set.
inline std::string detectOnnx(const std::string& dimensions, std::uint64_t element_type = 1) {
  const std::string tensor = detectNumber(1, element_type) + detectBytes(2, dimensions);
  const std::string input = detectBytes(1, "images") + detectBytes(2, detectBytes(1, tensor));
  return detectNumber(1, 7) + detectBytes(7, detectBytes(11, input)) + detectBytes(8, detectNumber(2, 12));
}
inline std::string detectDimension(std::uint64_t length) { return detectBytes(1, detectNumber(1, length)); }
inline std::string detectMetadata(const std::string& key, const std::string& value) {
  return detectBytes(14, detectBytes(1, key) + detectBytes(2, value));
}

}  // namespace field_fusion::core
