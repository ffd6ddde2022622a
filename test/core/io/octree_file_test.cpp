#include "field_fusion/core/io/octree_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "support/octomap_reference.h"
#include "support/temp_folder.h"

namespace field_fusion::core {
namespace {

VoxelMap aMap() {
  VoxelMap map;
  std::mt19937 random(3);
  std::normal_distribution<float> place;
  for (int scan = 0; scan < 3; ++scan) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 200; ++i) points.emplace_back(place(random), place(random), place(random));
    map.insert(points, {0.1f, 0.f, 0.3f});
  }
  return map;
}

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string faultOf(const std::filesystem::path& file, VoxelMap map = VoxelMap()) {
  try {
    readOctree(file, map);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(OctreeFile, IsReadByOctoMap) {
  const test::TempFolder folder;
  const VoxelMap map = aMap();
  writeOctree(folder.path() / "a.ot", map);
  const std::unique_ptr<octomap::AbstractOcTree> any(
      octomap::AbstractOcTree::read((folder.path() / "a.ot").string()));
  const auto* tree = dynamic_cast<octomap::OcTree*>(any.get());
  ASSERT_TRUE(tree);
  EXPECT_EQ(test::difference(map, *tree).different, 0u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "nothing else is left";
}

TEST(OctreeFile, ItsDataAloneIsReadByOctoMap) {
  const VoxelMap map = aMap();
  auto full = test::octreeLike(map.params()), binary = test::octreeLike(map.params());
  std::istringstream of_full(octreeData(map, false)), of_binary(octreeData(map, true));
  full.readData(of_full), binary.readBinaryData(of_binary);
  EXPECT_EQ(test::difference(map, full).different, 0u);
  map.store().forEach([&](const CubeKey& place, const VoxelCube& cube) {
    forEachBit(cube.known, [&](int i) {
      const VoxelKey voxel = voxelOf(place, i);
      const auto part = [&](int axis) { return static_cast<octomap::key_type>(voxel[axis] + kMostVoxels); };
      const auto* node = binary.search(octomap::OcTreeKey(part(0), part(1), part(2)));
      ASSERT_TRUE(node);
      ASSERT_EQ(binary.isNodeOccupied(node), map.isOccupied(cube.log_odds[i]));
    });
  });
  EXPECT_EQ(octreeData(VoxelMap(), false), "");
  EXPECT_EQ(octreeData(VoxelMap(), true), "");
}

TEST(OctreeFile, ComesBackAsItWas) {
  const test::TempFolder folder;
  const VoxelMap map = aMap();
  writeOctree(folder.path() / "a.ot", map);
  VoxelMap back;
  readOctree(folder.path() / "a.ot", back);
  auto tree = test::octreeLike(map.params());
  std::size_t voxels = 0;
  back.store().forEach([&](const CubeKey& place, const VoxelCube& cube) {
    forEachBit(cube.known, [&](int i) {
      ++voxels;
      ASSERT_EQ(map.logOdds(voxelOf(place, i)), cube.log_odds[i]);
    });
  });
  std::size_t before = 0;
  map.store().forEach(
      [&](const CubeKey&, const VoxelCube& cube) { forEachBit(cube.known, [&](int) { ++before; }); });
  EXPECT_EQ(voxels, before);
}

TEST(OctreeFile, BtKeepsWhatIsOccupiedAndWhatIsFree) {
  const test::TempFolder folder;
  const VoxelMap map = aMap();
  writeOctree(folder.path() / "a.bt", map);
  octomap::OcTree tree(0.05);
  ASSERT_TRUE(tree.readBinary((folder.path() / "a.bt").string()));
  VoxelMap back;
  readOctree(folder.path() / "a.bt", back);
  map.store().forEach([&](const CubeKey& place, const VoxelCube& cube) {
    forEachBit(cube.known, [&](int i) {
      const bool occupied = map.isOccupied(cube.log_odds[i]);
      ASSERT_EQ(back.isOccupied(back.logOdds(voxelOf(place, i))), occupied);
      const Eigen::Vector3d centre = map.lattice().centre(voxelOf(place, i));
      const auto* node = tree.search(centre.x(), centre.y(), centre.z());
      ASSERT_TRUE(node);
      ASSERT_EQ(tree.isNodeOccupied(node), occupied);
    });
  });
}

TEST(OctreeFile, OfNothingIsReadAsNothing) {
  const test::TempFolder folder;
  for (const char* name : {"a.ot", "a.bt"}) {
    writeOctree(folder.path() / name, VoxelMap());
    VoxelMap back;
    readOctree(folder.path() / name, back);
    EXPECT_EQ(back.store().size(), 0u) << name;
  }
}

class CutOctree : public testing::TestWithParam<const char*> {};

TEST_P(CutOctree, IsRefusedWhereverItIsCut) {
  const test::TempFolder folder;
  const auto whole = folder.path() / GetParam();
  VoxelMap few;
  few.set({0, 0, 0}, 1.f), few.set({100, -7, 3}, -1.f);
  writeOctree(whole, few);
  const std::string bytes = bytesOf(whole);
  const auto head = bytes.find("\ndata\n") + 6;  // a file that ends here is a tree of nothing
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    if (size == head) continue;
    folder.write(GetParam(), bytes.substr(0, size));
    ASSERT_NE(faultOf(whole).find(whole.string()), std::string::npos) << size << " bytes of " << bytes.size();
  }
  folder.write(GetParam(), bytes + "x");
  EXPECT_NE(faultOf(whole).find("goes on after the tree"), std::string::npos);
}

TEST_P(CutOctree, ThatLeadsDownWithoutEndIsRefused) {
  const test::TempFolder folder;
  writeOctree(folder.path() / GetParam(), aMap());
  const std::string bytes = bytesOf(folder.path() / GetParam());
  const std::string down(4'000'000, std::strcmp(GetParam(), "a.bt") == 0 ? '\xff' : '\x01');
  const auto file = folder.write(GetParam(), bytes.substr(0, bytes.find("\ndata\n") + 6) + down);
  EXPECT_NE(faultOf(file).find("deeper than 16"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(OctreeFile, CutOctree, testing::Values("a.ot", "a.bt"));

TEST(OctreeFile, AHeaderThatDoesNotFitItsTreeIsRefused) {
  const test::TempFolder folder;
  writeOctree(folder.path() / "a.ot", aMap());
  const std::string bytes = bytesOf(folder.path() / "a.ot");
  const auto with = [&](const std::string& name, const std::string& value) {
    const auto at = bytes.find("\n" + name + " ") + 1;
    return faultOf(folder.write("b.ot", bytes.substr(0, at) + value + bytes.substr(bytes.find('\n', at))));
  };
  EXPECT_NE(with("size", "size 3").find("not what its header says (size)"), std::string::npos);
  EXPECT_NE(with("size", "# none").find("not what its header says (size)"), std::string::npos);
  for (const char* res : {"res 0", "res -0.05", "res nan", "res abc", "# none"})
    EXPECT_NE(with("res", res).find("size of its voxels (res)"), std::string::npos) << res;
}

TEST(OctreeFile, FaultsNameTheFile) {
  const test::TempFolder folder;
  EXPECT_NE(faultOf("/nowhere/a.bt").find("/nowhere/a.bt: cannot be read"), std::string::npos);
  EXPECT_NE(faultOf("a.ply").find("ends neither in .bt nor in .ot"), std::string::npos);
  EXPECT_NE(faultOf(folder.write("a.bt", "P5 1 1")).find("its first line"), std::string::npos);
  VoxelMapParams coarse;
  coarse.resolution = 0.1;
  writeOctree(folder.path() / "a.ot", aMap());
  EXPECT_NE(faultOf(folder.path() / "a.ot", VoxelMap(coarse)).find("of 0.05 m, not 0.1 m"),
            std::string::npos);
  std::filesystem::create_directory(folder.path() / "folder.ot");
  EXPECT_NE(faultOf(folder.path() / "folder.ot").find("it is a folder"), std::string::npos);
  try {
    writeOctree(folder.path() / "no/a.ot", aMap());
    ADD_FAILURE() << "there is no such folder";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("no/a.ot: No such file or directory"), std::string::npos) << e.what();
  }
  EXPECT_THROW(writeOctree(folder.path() / "a.ply", aMap()), std::runtime_error);
}

}  // namespace
}  // namespace field_fusion::core
