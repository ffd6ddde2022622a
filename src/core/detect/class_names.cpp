#include "field_fusion/core/detect/class_names.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace field_fusion::core {
namespace {

/// A list, or a dictionary with the keys 0 ... n-1 in any order.
std::vector<std::string> namesOf(const YAML::Node& node) {
  if (!node.IsSequence() && !node.IsMap())
    throw std::runtime_error("'names' is neither a list nor a dictionary");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const YAML::Node name = node[i];
    if (!name) throw std::runtime_error("'names' lacks class " + std::to_string(i));
    names.push_back(name.as<std::string>());
  }
  return names;
}

/// Both notations of Python that occur are YAML's flow style too.
std::vector<std::string> parseLiteral(const std::string& text) { return namesOf(YAML::Load(text)); }

std::vector<std::string> readYaml(std::istream& stream) {
  const YAML::Node root = YAML::Load(stream);
  if (!root.IsMap() || !root["names"]) throw std::runtime_error("there is no entry 'names'");
  return namesOf(root["names"]);
}

std::vector<std::string> readLines(std::istream& stream) {
  constexpr const char* kSpace = " \t\r";
  std::vector<std::string> names;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find_first_not_of(kSpace);
    names.push_back(
        first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(kSpace) - first + 1));
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty()) throw std::runtime_error("line " + std::to_string(i + 1) + " is empty");
  return names;
}

/// A list of another model would give every body a wrong name, so a longer one is refused as well.
std::vector<std::string> counted(std::vector<std::string> names, int classes) {
  if (names.size() != static_cast<std::size_t>(classes))
    throw std::runtime_error(std::to_string(names.size()) + " class names, but the model has " +
                             std::to_string(classes) + " classes");
  return names;
}

}  // namespace

std::vector<std::string> classNamesOf(const OnnxFile& model, int classes) {
  const auto entry = model.metadata.find("names");
  if (entry == model.metadata.end())
    throw std::runtime_error("model '" + model.path + "' does not name its classes: give a class file");
  try {
    return counted(parseLiteral(entry->second), classes);
  } catch (const std::exception& fault) {
    throw std::runtime_error("model '" + model.path + "', metadata 'names': " + fault.what());
  }
}

std::string contradictionOf(const OnnxFile& model, const std::vector<std::string>& names) try {
  const auto own = classNamesOf(model, static_cast<int>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] != own[i])
      return "class " + std::to_string(i) + " is '" + names[i] + "', in the model file '" + own[i] + "'";
  return "";
} catch (const std::runtime_error&) {
  return "";
}

std::vector<std::string> readClassNames(const std::string& path, int classes) {
  try {
    std::ifstream stream(path);
    if (!stream || std::filesystem::is_directory(path)) throw std::runtime_error("cannot be read");
    const std::string extension = std::filesystem::path(path).extension();
    return counted(extension == ".yaml" || extension == ".yml" ? readYaml(stream) : readLines(stream),
                   classes);
  } catch (const std::exception& fault) {
    throw std::runtime_error("class file '" + path + "': " + fault.what());
  }
}

}  // namespace field_fusion::core
