// Refuses a robot's parameter file whose top level is not stages, then becomes the command behind it. No
// stage can see this by itself: the values below a misspelt name belong to nobody.
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "field_fusion/ros/stage_declarations.h"

namespace {

bool isStage(const std::string& name) {
  const auto& all = field_fusion::stageDeclarations();
  return std::any_of(all.begin(), all.end(), [&](const auto& stage) { return stage.name == name; });
}

/// What is wrong with the file, a line for each fault; empty: nothing.
std::string faults(const std::string& path) try {
  std::string out;
  const YAML::Node file = YAML::LoadFile(path);
  if (!file.IsMap() && !file.IsNull()) return "  it is no table of stages\n";
  for (const auto& entry : file) {
    const auto name = entry.first.as<std::string>();
    if (!isStage(name))
      out += "  " + name + " is not a stage\n";
    else if (!entry.second.IsMap() && !entry.second.IsNull())
      out += "  " + name + " holds no parameters\n";
  }
  return out;
} catch (const YAML::Exception& e) {
  return std::string("  ") + e.what() + "\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: check_robot FILE [COMMAND...]\n";
    return 2;
  }
  if (const auto text = faults(argv[1]); !text.empty()) {
    std::cerr << "check_robot: " << argv[1] << ":\n" << text << "stages:";
    for (const auto& stage : field_fusion::stageDeclarations()) std::cerr << " " << stage.name;
    std::cerr << std::endl;
    return 1;
  }
  if (argc == 2) return 0;
  execvp(argv[2], argv + 2);
  std::cerr << "check_robot: cannot start " << argv[2] << std::endl;
  return 1;
}
