#pragma once
// A YAML file read with care: every fault names file, line and key.
#include <yaml-cpp/yaml.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace field_fusion::core::sim {

/// A node of a file, and the way to it, such as bodies[2].pose.
class Yaml {
 public:
  /// Throws std::runtime_error for a file that cannot be read or is not YAML.
  static Yaml file(const std::string& path);

  /// Throws std::runtime_error: "FILE:LINE: KEY: reason".
  [[noreturn]] void fail(const std::string& reason) const;
  /// The same for what `action` throws.
  void check(const std::function<void()>& action) const;

  bool isMap() const { return node_.IsMap(); }
  bool isList() const { return node_.IsSequence(); }
  bool isText() const { return node_.IsScalar(); }
  /// Fails unless this is a map of these keys alone, each at most once.
  void onlyKeys(const std::vector<std::string>& known) const;
  /// Fails unless this is a map in which each key is there at most once.
  std::vector<std::string> keys() const;
  bool has(const std::string& key) const;
  Yaml operator[](const std::string& key) const;  ///< fails when it is not there
  std::vector<Yaml> list() const;

  double number() const;  ///< finite
  double number(double lo, double hi) const;
  double positive(double lo = 1e-6, double hi = 1e6) const;
  double place() const;     ///< [m] at most 10 km from the origin: rays are cast in single precision
  double angle() const;     ///< [rad] of degrees, at most ten turns
  int whole(int lo, int hi) const;
  bool flag() const;
  std::string text() const;
  std::vector<Yaml> list(std::size_t fewest, std::size_t most) const;  ///< of numbers
  std::vector<double> numbers(std::size_t fewest, std::size_t most) const;
  std::string dump() const;  ///< as YAML again
  std::size_t oneOf(const std::vector<std::string>& choices) const;
  const std::string& fileName() const { return *file_; }

 private:
  Yaml(YAML::Node node, std::shared_ptr<const std::string> file, std::string key)
      : node_(std::move(node)), file_(std::move(file)), key_(std::move(key)) {}

  YAML::Node node_;
  std::shared_ptr<const std::string> file_;
  std::string key_;
};

/// As people write it, to six digits after the point; with an exponent where that is shorter or more.
std::string shortNumber(double value);

/// " (did you mean NAME?)" for the one most like it, or nothing where none is.
std::string nearestName(const std::string& name, const std::vector<std::string>& known);

}  // namespace field_fusion::core::sim
