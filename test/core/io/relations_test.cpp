#include "field_fusion/core/io/relations.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace field_fusion::core {
namespace {

std::filesystem::path file(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("relations_" + std::to_string(getpid()) + ".txt");
  std::ofstream(path) << text;
  return path;
}

TEST(Relations, ErrorsOfHandMadeOnes) {
  // the truth goes 1 m ahead, then turns left by 90 degrees
  const std::vector<StampedPose2> poses = {{1'000'000'000, {5, 5, radians(90.0)}},
                                           {2'000'000'000, {5, 6.1, radians(90.0)}},
                                           {3'000'000'000, {5, 6.1, radians(190.0)}}};
  const auto relations = readRelations(file("1.0 2.0 1 0 0 0 0 0\n2.0 3.0 0 0 0 0 0 1.5707963\n# none\n1 9.5 0 0 0 0 0 0\n"));
  const RelationScore score = scoreRelations(poses, relations);
  ASSERT_EQ(score.translation.size(), 2u);
  EXPECT_EQ(score.missing, 1u);
  EXPECT_NEAR(score.translation[0], 0.1, 1e-9);
  EXPECT_NEAR(score.translation[1], 0.0, 1e-9);
  EXPECT_NEAR(score.rotation[0], 0.0, 1e-9);
  EXPECT_NEAR(score.rotation[1], radians(10.0), 1e-6);
  EXPECT_NEAR(score.absoluteTranslation().mean, 0.05, 1e-9);
  EXPECT_NEAR(score.absoluteTranslation().deviation, 0.05, 1e-9);
  EXPECT_NEAR(score.squaredTranslation().mean, 0.005, 1e-9);
  EXPECT_NEAR(degrees(score.absoluteRotation().mean), 5.0, 1e-5);
  EXPECT_TRUE(std::isnan(RelationScore().absoluteTranslation().mean));
}

TEST(Relations, FaultsAreNamedByFileAndLine) {
  EXPECT_THROW(readRelations("/nowhere"), std::runtime_error);
  for (const char* bad : {"1 2 3\n", "1 2 0 0 0 0 0 0 0\n", "1 2 x 0 0 0 0 0\n", "a 2 0 0 0 0 0 0\n", "1 2 nan 0 0 0 0 0\n"}) {
    const auto path = file(std::string("1 2 0 0 0 0 0 0\n") + bad);
    try {
      readRelations(path);
      ADD_FAILURE() << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(path.string() + ":2"), std::string::npos) << e.what();
    }
  }
}

TEST(Relations, AFileOfRelationsIsNoFileOfPoses) {
  EXPECT_THROW(readPoses(file("1 2 0.5 0 0 0 0 0.1\n")), std::runtime_error);
  EXPECT_EQ(readPoses(file("1 2 0.5 0.1\n")).size(), 1u);
}

TEST(Relations, PublishedPosesHaveThePublishedError) {
  const char* data = std::getenv("FIELD_FUSION_DATA");
  if (!data) GTEST_SKIP() << "FIELD_FUSION_DATA is not set";
  const auto folder = std::filesystem::path(data) / "slam2d";
  const RelationScore score = scoreRelations(readPoses(folder / "intel_gmapping_reference_910.txt"),
                                             readRelations(folder / "intel_exact910.relations"));
  EXPECT_EQ(score.translation.size(), 111u);
  EXPECT_NEAR(score.absoluteTranslation().mean, 0.041, 0.0005);
  EXPECT_NEAR(score.absoluteTranslation().deviation, 0.043, 0.0005);
  EXPECT_NEAR(degrees(score.absoluteRotation().mean), 0.81, 0.005);
}

}  // namespace
}  // namespace field_fusion::core
