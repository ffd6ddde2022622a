#include "field_fusion/ros/parameter_files.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iterator>
#include <set>

#include "field_fusion/ros/stage_declarations.h"

namespace field_fusion {
namespace {

std::string contentsOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ParameterFiles, CommittedOnesAreWhatTheDeclarationsSay) {
  for (const auto& file : parameterFiles())
    EXPECT_EQ(contentsOf(PROJECT_DIR "/" + file.path), file.text)
        << file.path << " is stale: run rosrun field_fusion write_params";
}

TEST(ParameterFiles, NoTwoStagesSendOneFrame) {
  std::set<std::string> frames;
  int stages = 0;
  for (const auto& stage : stageDeclarations()) {
    const auto yaml = YAML::LoadFile(PROJECT_DIR "/config/" + stage.name + ".yaml");
    if (!yaml["plane_frame"]) continue;
    ++stages;
    EXPECT_TRUE(frames.insert(yaml["plane_frame"].as<std::string>()).second) << stage.name;
  }
  EXPECT_GE(stages, 2);
}

TEST(ParameterFiles, YamlReadsEveryDefaultInItsDeclaredType) {
  for (const auto& stage : stageDeclarations())
    stage.withDefaults([&](const core::Params& params) {
      const auto yaml = YAML::LoadFile(PROJECT_DIR "/config/" + stage.name + ".yaml");
      ASSERT_EQ(yaml.size(), params.list().size()) << stage.name;
      for (const auto& param : params.list()) {
        const auto value = param.get();
        const auto text = yaml[param.name].as<std::string>("");
        if (const auto* d = std::get_if<double>(&value)) {
          EXPECT_EQ(yaml[param.name].as<double>(), *d) << param.name;
          EXPECT_NE(text.find('.'), std::string::npos)
              << param.name << " would be read as an int or a string";
        }
        std::string expected = text;
        if (const auto* i = std::get_if<int>(&value)) expected = std::to_string(*i);
        if (const auto* b = std::get_if<bool>(&value)) expected = *b ? "true" : "false";
        if (const auto* s = std::get_if<std::string>(&value)) expected = *s;
        EXPECT_EQ(text, expected) << param.name;
      }
    });
}

}  // namespace
}  // namespace field_fusion
