// Writes config/<stage>.yaml, docs/parameters.md and docs/shapes.md from the declarations. A test fails when they are stale.
#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>

#include "field_fusion/core/sim/shapes.h"
#include "field_fusion/ros/parameter_files.h"

int main(int argc, char** argv) {
  CLI::App app("Writes config/<stage>.yaml, docs/parameters.md and docs/shapes.md of a field_fusion checkout.");
  std::string folder = ".";
  app.add_option("folder", folder, "Root of the checkout")->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  auto files = field_fusion::parameterFiles();
  files.push_back({"docs/shapes.md", field_fusion::core::sim::shapesDocument()});
  for (const auto& file : files) {
    std::ofstream out(folder + "/" + file.path);
    out << file.text;
    if (!out.flush()) {
      std::cerr << "write_params: cannot write " << folder << "/" << file.path << "\n";
      return 1;
    }
  }
}
