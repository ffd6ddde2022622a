// A stage that is wrongly set up does not start, and says all that is wrong in one message.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "field_fusion/core/io/map_file.h"
#include "support/stage_probe.h"
#include "support/temp_folder.h"

namespace field_fusion::test {
namespace {

struct Outcome {
  std::string text;
  int status = -1;
};

/// Runs a stage as a process of its own that is expected to end by itself; it is ended after 20 s.
Outcome start(const std::string& stage, const std::string& name, const std::string& private_params) {
  const auto command = "timeout 20 rosrun nodelet nodelet standalone field_fusion/" + stage +
                       " __name:=" + name + " " + private_params + " 2>&1";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 512> buffer;
  while (fgets(buffer.data(), buffer.size(), pipe)) outcome.text += buffer.data();
  outcome.status = WEXITSTATUS(pclose(pipe));
  return outcome;
}

constexpr int kRefused = 255;  // of nodelet

/// It ends by itself, and not by a signal (128 and more).
#define EXPECT_REFUSED(outcome) EXPECT_EQ((outcome).status, kRefused) << (outcome).text
#define EXPECT_SAYS(outcome, words) EXPECT_NE((outcome).text.find(words), std::string::npos) << (outcome).text

TEST(Refuse, EveryFaultOfTheParametersIsInOneMessage) {
  const auto outcome = start("filter", "refused_filter", "_min_range:=-3.0 _max_range:=six _voxel_sze:=0.1");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "max_range is a string but must be a double");
  EXPECT_SAYS(outcome, "min_range = -3.0 is outside [0.0, 1000.0] m");
  EXPECT_SAYS(outcome, "voxel_sze is not a parameter of this stage");
}

TEST(Refuse, BrokenRuleNamesItsParameters) {
  const auto outcome = start("filter", "refused_rule", "_min_range:=5.0 _max_range:=2.0");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "min_range must not exceed max_range");
}

TEST(Refuse, AnotherNameIsNamedAsItWasGiven) {
  const auto outcome = start("grid_slam", "refused_alias", "_angularUpdate:=100.0");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "angularUpdate: angular_update = ");
}

TEST(Refuse, MapOfAnotherResolutionIsNamedByItsFile) {
  const TempFolder folder;
  const std::string file = (folder.path() / "coarse.yaml").string();
  core::writeMap(file, {0.2, 0.0, 0.0, 1, 1, {0}});
  const auto outcome = start("grid_slam", "refused_map", "_map_file:=" + file);
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "map " + file + ": the map's resolution is 0.2");
}

TEST(Refuse, StartOutsideOfTheMapIsNamed) {
  const TempFolder folder;
  const std::string file = (folder.path() / "small.yaml").string();
  core::writeMap(file, {0.05, 0.0, 0.0, 1, 1, {0}});
  const auto outcome = start("grid_slam", "refused_start", "_map_file:=" + file + " _start_x:=500.0");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "map " + file + ": start_x and start_y lie outside of it");
}

TEST(Refuse, WholeNumberIsTakenForADouble) {
  const auto outcome = start("filter", "taken_int", "_max_range:=20 _typo:=1");
  EXPECT_SAYS(outcome, "typo is not a parameter of this stage");
  EXPECT_EQ(outcome.text.find("max_range"), std::string::npos) << outcome.text;
}

TEST(Refuse, ListOfTheWrongThingIsNamed) {
  ros::param::set("/refused_list/box", std::vector<std::string>{"a", "b"});
  const auto outcome = start("filter", "refused_list", "");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "box is a list but must be a list of double");
}

TEST(Refuse, ImageTransportThatIsNotInstalled) {
  const auto model = "_model:=" + std::string(PROJECT_DIR) + "/test/fixtures/stock_head.onnx";
  const auto outcome = start("detect", "refused_transport", model + " _image_transport:=smoke_signals");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "image_transport: smoke_signals is not installed; there are: ");
}

TEST(Refuse, ModelThatIsMissing) {
  const auto outcome = start("detect", "refused_missing", "_model:=/no/such/model.onnx");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "/no/such/model.onnx");
}

TEST(Refuse, ModelThatIsCutShort) {
  const std::string path = testing::TempDir() + "refuse_cut.onnx";
  {
    const auto whole = std::string(PROJECT_DIR) + "/test/fixtures/stock_head.onnx";
    ASSERT_EQ(std::system(("head -c 900 " + whole + " > " + path).c_str()), 0);
  }
  const auto outcome = start("detect", "refused_cut", "_model:=" + path);
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, path);
}

TEST(Refuse, ModelOfAnotherShapeIsNamedWithItsShape) {
  const auto outcome =
      start("detect", "refused_shape", "_model:=" PROJECT_DIR "/test/fixtures/transposed_head.onnx");
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, "1x21x6");
}

TEST(Refuse, VoxelsThatAreCutShort) {
  const std::string path = testing::TempDir() + "refuse_cut.bt";
  std::ofstream(path) << "# Octomap OcTree binary file\nid OcTree\nsize 100\nres 0.05\ndata\n\x01";
  const auto outcome = start("voxel_map", "refused_voxels", "_map_file:=" + path);
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, path);
}

TEST(Refuse, ClassFileShorterThanTheModelsClasses) {
  const std::string path = testing::TempDir() + "refuse_classes.txt";
  ASSERT_EQ(std::system(("echo red > " + path).c_str()), 0);
  const auto outcome = start("detect", "refused_classes",
                             "_model:=" PROJECT_DIR "/test/fixtures/stock_head.onnx _class_file:=" + path);
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, path);
  EXPECT_SAYS(outcome, "2");
}

TEST(Refuse, CalibrationThatCannotBeHad) {
  const std::string model = "_model:=" PROJECT_DIR "/test/fixtures/stock_head.onnx _camera_info_url:=";
  const auto scheme = start("detect", "refused_scheme", model + "http://somewhere/camera.yaml");
  EXPECT_REFUSED(scheme);
  EXPECT_SAYS(scheme, "camera_info_url http://somewhere/camera.yaml: must be file:///PATH or package://");
  const auto missing = start("detect", "refused_file", model + "file:///no/such/camera.yaml");
  EXPECT_REFUSED(missing);
  EXPECT_SAYS(missing, "camera_info_url file:///no/such/camera.yaml: no calibration can be read from it");
}

TEST(Refuse, CalibrationOfACameraWithoutFocalLength) {
  const std::string path = testing::TempDir() + "refuse_camera.yaml";
  ASSERT_EQ(std::system(("sed 's/20\\.0/0.0/g' " PROJECT_DIR "/test/fixtures/camera.yaml > " + path).c_str()), 0);
  const auto outcome = start("detect", "refused_focal",
                             "_model:=" PROJECT_DIR "/test/fixtures/stock_head.onnx _camera_info_url:=file://" + path);
  EXPECT_REFUSED(outcome);
  EXPECT_SAYS(outcome, path);
  EXPECT_SAYS(outcome, "camera info is not calibrated");
}

}  // namespace
}  // namespace field_fusion::test
