#include "field_fusion/core/io/map_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/temp_folder.h"

namespace field_fusion::core {
namespace {

const Occupancy kMap{0.05, -1.6, 3.2, 3, 2, {0, 100, -1, -1, 0, 100}};

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(MapFile, IsAsMapServerReadsIt) {
  const test::TempFolder folder;
  writeMap(folder.path() / "a.yaml", kMap);
  EXPECT_EQ(bytesOf(folder.path() / "a.pgm"), std::string("P5\n3 2\n255\n\xcd\xfe\x00\xfe\x00\xcd", 17)) << "the upper row first";
  EXPECT_EQ(bytesOf(folder.path() / "a.yaml"),
            "image: a.pgm\nresolution: 0.05\norigin: [-1.6, 3.2, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "nothing else is left";
}

TEST(MapFile, ComesBackAsItWas) {
  const test::TempFolder folder;
  writeMap(folder.path() / "a.yaml", kMap);
  const Occupancy back = readMap(folder.path() / "a.yaml");
  EXPECT_EQ(back.cells, kMap.cells);
  EXPECT_EQ(back.width, 3);
  EXPECT_DOUBLE_EQ(back.x, -1.6);
  EXPECT_DOUBLE_EQ(back.resolution, 0.05);
}

TEST(MapFile, ComesBackWhateverItsName) {
  const test::TempFolder folder;
  for (const char* name : {"my map #2.yaml", "a: b.yaml", "- x.yaml", "\"q\".yaml"}) {
    writeMap(folder.path() / name, kMap);
    EXPECT_EQ(readMap(folder.path() / name).cells, kMap.cells) << name;
  }
}

TEST(MapFile, ThatCannotBeWrittenLeavesTheOldOne) {
  const test::TempFolder folder;
  EXPECT_THROW(writeMap(folder.path() / "none" / "a.yaml", kMap), std::runtime_error);
  EXPECT_THROW(writeMap(folder.path() / "a.pgm", kMap), std::runtime_error) << "the name is the YAML file's";
  EXPECT_THROW(writeMap(folder.path() / "a.yaml", {}), std::runtime_error) << "no map yet";
  std::filesystem::create_directories(folder.path() / "b.yaml" / "full");
  EXPECT_THROW(writeMap(folder.path() / "b.yaml", kMap), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.pgm")) << "a new picture beside an old file would be another map";
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST(MapFile, FaultsAreNamed) {
  const test::TempFolder folder;
  const std::string good =
      "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const auto fault = [&](const std::string& text) {
    folder.write("a.yaml", text);
    try {
      readMap(folder.path() / "a.yaml");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_NE(fault(good).find("a.yaml: cannot read image"), std::string::npos);
  folder.write("a.pgm", "P5\n1 1\n255\n\xfe");
  EXPECT_EQ(fault(good), "");
  EXPECT_NE(fault(with("resolution: 0.05\n", "")).find("no resolution"), std::string::npos);
  EXPECT_NE(fault(with("0, 0]", "0, 1.5]")).find("turned"), std::string::npos);
  EXPECT_NE(fault(with("0.05", ".nan")).find("no length"), std::string::npos);
  EXPECT_NE(fault(with("0.65", ".nan")).find("occupied_thresh are not"), std::string::npos);
  EXPECT_NE(fault(with("0.196", "0.7")).find("free <= occupied"), std::string::npos);
  EXPECT_NE(fault(good + "mode: scale\n").find("mode is scale"), std::string::npos);
  EXPECT_NE(fault("[").find("a.yaml"), std::string::npos);
  folder.write("a.pgm", "P5\n9 9\n255\n\xfe");
  EXPECT_NE(fault(good).find("cannot read image"), std::string::npos) << "half a picture";
}

}  // namespace
}  // namespace field_fusion::core
