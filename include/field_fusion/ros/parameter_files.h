#pragma once
#include <string>
#include <vector>

namespace field_fusion {

/// A file that is generated from the declarations of all stages.
struct ParameterFile {
  std::string path;  ///< relative to the root of the checkout
  std::string text;
};

/// config/<stage>.yaml for each stage, and docs/parameters.md.
std::vector<ParameterFile> parameterFiles();

}  // namespace field_fusion
