#include "field_fusion/core/io/kitti.h"

#include <gtest/gtest.h>

#include "support/faults.h"
#include "support/kitti_folder.h"

namespace field_fusion::core {
namespace {

using test::faultOf;
using test::KittiFolder;
using test::says;
namespace fs = std::filesystem;

std::string listFault(const fs::path& folder) {
  return faultOf([&] { listKitti(folder); });
}

TEST(ListKitti, PairsTheFilesOfOneName) {
  const KittiFolder folder(3);
  const auto frames = listKitti(folder.path());
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].cloud, folder.path() / "velodyne/000001.bin");
  EXPECT_EQ(frames[1].image, folder.path() / "image_2/000001.png");
  EXPECT_EQ(frames[1].calibration, folder.path() / "calib.txt");
}

TEST(ListKitti, TakesACalibrationForEachFrame) {
  const KittiFolder folder(2);
  for (const char* name : {"calib/000000.txt", "calib/000001.txt"})
    folder.write(name, test::kKittiCalibration);
  EXPECT_EQ(listKitti(folder.path())[1].calibration, folder.path() / "calib/000001.txt");
}

TEST(ListKitti, LeavesTheImageEmptyWhereThereAreNone) {
  const KittiFolder folder(2, /*images=*/false);
  EXPECT_TRUE(listKitti(folder.path())[0].image.empty());
}

TEST(ListKitti, RefusesAMissingFolderAndOneWithoutClouds) {
  const test::TempFolder empty;
  EXPECT_TRUE(says(listFault(empty.path() / "none"), "no such folder: " + (empty.path() / "none").string()));
  EXPECT_TRUE(says(listFault(empty.path()), "no frames: " + (empty.path() / "velodyne").string()));
}

TEST(ListKitti, RefusesCloudsAndImagesThatDoNotBelongTogether) {
  const KittiFolder folder(2);
  fs::rename(folder.path() / "image_2/000001.png", folder.path() / "image_2/000007.png");
  EXPECT_TRUE(says(listFault(folder.path()), "image_2/000001.png"));
  fs::remove(folder.path() / "image_2/000007.png");
  EXPECT_TRUE(says(listFault(folder.path()), "differ in number: 2 in"));
}

TEST(ReadKittiCloud, AddsRowAndTimeToWhatIsStored) {
  const test::TempFolder folder;
  const fs::path file = folder.write("a.bin", test::kittiBytes({10, 0, 0, 0.5f, 0, 10, 0, 0.25f}));
  const Cloud cloud = readKittiCloud(file, 0.2);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud[1].position(), Eigen::Vector3f(0, 10, 0));
  EXPECT_EQ(cloud[1].intensity, 0.25f);
  EXPECT_EQ(cloud[0].ring, 32 + 25);  // 0 deg = -8.33 + 25 / 3
  EXPECT_FLOAT_EQ(cloud[0].time, 0.f);
  EXPECT_FLOAT_EQ(cloud[1].time, 0.05f);  // a quarter of 0.2 s
}

TEST(ReadKittiCloud, KeepsPointsThatAreNotFinite) {
  const test::TempFolder folder;
  const Cloud cloud = readKittiCloud(folder.write("a.bin", test::kittiBytes({NAN, 0, 0, 1})));
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_EQ(cloud[0].ring, kUnknownRing);
  EXPECT_TRUE(std::isnan(cloud[0].time));
}

TEST(ReadKittiCloud, TakesAnEmptyFile) {
  const test::TempFolder folder;
  EXPECT_TRUE(readKittiCloud(folder.write("a.bin", "")).empty());
}

TEST(ReadKittiCloud, NamesATruncatedAndAMissingFile) {
  const test::TempFolder folder;
  const fs::path file = folder.write("a.bin", std::string(17, 'x'));
  EXPECT_TRUE(
      says(faultOf([&] { readKittiCloud(file); }), "truncated cloud: " + file.string() + " has 17 bytes"));
  EXPECT_TRUE(says(faultOf([&] { readKittiCloud(folder.path() / "b.bin"); }), "b.bin"));
}

TEST(ReadKittiCloud, ReadsTheRealRecording) {
  const fs::path folder = test::recording("kitti_sequence");
  if (folder.empty()) GTEST_SKIP() << "FIELD_FUSION_DATA is not set";
  const auto frames = listKitti(folder);
  ASSERT_EQ(frames.size(), 10u);
  EXPECT_EQ(readKittiCloud(frames[0].cloud).size(), fs::file_size(frames[0].cloud) / 16);
  EXPECT_FALSE(frames[9].image.empty());
}

}  // namespace
}  // namespace field_fusion::core
