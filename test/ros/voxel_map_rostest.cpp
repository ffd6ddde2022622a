// Depth over topics: a camera that looks along x of a map, a wall 2 m ahead, and what goes wrong on a robot.
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Empty.h>
#include <visualization_msgs/MarkerArray.h>

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "field_fusion/SaveMap.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/octomap_output.h"
#include "support/depth_room.h"
#include "support/frames.h"
#include "support/stage_probe.h"
#include "support/temp_folder.h"

namespace field_fusion::test {
namespace {

class VoxelMapStage : public testing::Test {
 protected:
  void SetUp() override {
    frames_.sendStatic("base", "sensor", core::Transform(Eigen::Translation3d(0.0, 0.0, 0.3)));
    frames_.sendStatic("base", "camera", cameraAt(0.0, 0.3, 0.0));
    ASSERT_TRUE(spinUntil([this] {
      return cloud_.connected() && image_.connected() && info_.connected() && map_.connected() &&
             by_image_.connected();
    }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  std_msgs::Header header(const std::string& frame) const {
    std_msgs::Header out;
    out.frame_id = frame;
    out.stamp.fromSec(now_);
    return out;
  }
  /// Of a wall `distance` ahead, with gaps smaller than a voxel; of none where it is 0.
  CloudMessage wall(double distance) const {
    CloudMessage out;
    out.header = header("sensor");
    for (double y = -0.5; y < 0.5 && distance > 0.0; y += 0.02)
      for (double z = -0.1; z < 0.2; z += 0.02) {
        core::Point& p = out.points.emplace_back();
        p.x = static_cast<float>(distance), p.y = static_cast<float>(y), p.z = static_cast<float>(z);
      }
    return out;
  }
  void next() {
    now_ += 0.1;
    for (const double stamp : {now_ - 0.05, now_ + 0.05}) frames_.send(stamp, "map", "base", T_map_base_);
  }
  bool came(const Received<nav_msgs::OccupancyGrid>& map) const {
    return map.last && map.last->header.stamp == ros::Time(now_);
  }
  /// Whether a map comes to a cloud of the wall.
  bool sees(double distance) {
    return askUntil([this] { return came(map_); }, [&] { next(), cloud_.send(wall(distance)); });
  }
  /// The same of an image, by the stage whose heights are those over the ground below the base.
  bool seesByImage() {
    DepthRoom room;
    room.width = 160, room.height = 120, room.focal = 100.0, room.wall = 2.02;
    room.T_base_camera = cameraAt(0.0, 0.3, 0.0);
    const auto pixels = room.pixels<std::uint16_t>(0.001);
    return askUntil([this] { return came(by_image_); }, [&] {
      next();
      const core::Pinhole camera{room.focal, room.focal, 0.5 * room.width, 0.5 * room.height};
      info_.send(cameraInfo(header("camera"), camera, {room.width, room.height}));
      sensor_msgs::Image image;
      image.header = header("camera");
      image.width = static_cast<std::uint32_t>(room.width), image.height = static_cast<std::uint32_t>(room.height);
      image.encoding = "16UC1", image.step = image.width * 2;
      image.data.resize(pixels.size() * 2);
      std::memcpy(image.data.data(), pixels.data(), image.data.size());
      image_.send(image);
    });
  }
  static int cellAt(const nav_msgs::OccupancyGrid& map, double x, double y) {
    const int u = static_cast<int>(std::floor((x - map.info.origin.position.x) / map.info.resolution));
    const int v = static_cast<int>(std::floor((y - map.info.origin.position.y) / map.info.resolution));
    return map.data.at(static_cast<std::size_t>(v) * map.info.width + u);
  }
  bool says(const std::string& words) const { return diagnostics_.says("voxel_map", words); }
  std::string value(const std::string& key) { return diagnostics_.value("voxel_map", key); }

  double now_ = 0.0;
  core::Transform T_map_base_ = core::Transform::Identity();
  Frames frames_;
  Sender<CloudMessage> cloud_{"points"};
  Sender<sensor_msgs::Image> image_{"image"};
  Sender<sensor_msgs::CameraInfo> info_{"camera_info"};
  Received<nav_msgs::OccupancyGrid> map_{"projected_map"}, by_image_{"by_image/projected_map"};
  Received<visualization_msgs::MarkerArray> voxels_{"voxels"};
  Diagnostics diagnostics_;
};

TEST_F(VoxelMapStage, WallIsOccupiedAndTheWayToItFree) {
  ASSERT_TRUE(sees(2.02));
  EXPECT_EQ(map_.last->header.frame_id, "map");
  EXPECT_GE(cellAt(*map_.last, 2.02, 0.02), 50);
  EXPECT_LT(cellAt(*map_.last, 1.0, 0.02), 50);
  EXPECT_GE(cellAt(*map_.last, 1.0, 0.02), 0);
  EXPECT_EQ(cellAt(*map_.last, 2.5, 0.02), -1) << "nobody looked behind it";
  ASSERT_TRUE(spinUntil([this] { return voxels_.last != nullptr; }));
  ASSERT_EQ(voxels_.last->markers.size(), 1u);
  EXPECT_FALSE(voxels_.last->markers[0].points.empty());
  for (const auto& p : voxels_.last->markers[0].points) {
    EXPECT_NEAR(p.x, 2.025, 1e-6);
    EXPECT_GT(p.z, 0.05) << "no floor";
  }
  EXPECT_EQ(voxels_.last->markers[0].points.size(), voxels_.last->markers[0].colors.size());
}

TEST_F(VoxelMapStage, FollowsTheRobot) {
  T_map_base_ = core::Transform(Eigen::Translation3d(30.0, 5.0, 0.0) *
                                Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  ASSERT_TRUE(sees(2.02));
  EXPECT_GE(cellAt(*map_.last, 29.98, 7.02), 50);
  EXPECT_NEAR(map_.last->info.origin.position.x, 25.0, 0.051) << "a square of 10 m about the sensor";
  EXPECT_NEAR(map_.last->info.origin.position.y, 0.0, 0.051);
}

TEST_F(VoxelMapStage, AnImageSaysTheSame) {
  ASSERT_TRUE(seesByImage());
  EXPECT_GE(cellAt(*by_image_.last, 2.02, 0.02), 50);
  EXPECT_LT(cellAt(*by_image_.last, 1.0, 0.02), 50);
}

TEST_F(VoxelMapStage, AHeightThatDriftsMakesNoObstacleOfTheFloorWhereTheBaseIsOnIt) {
  for (const double drift : {0.08, -0.3, 1.0}) {
    T_map_base_ = core::Transform(Eigen::Translation3d(0.0, 0.0, drift));
    ASSERT_TRUE(seesByImage());
    EXPECT_GE(cellAt(*by_image_.last, 2.02, 0.02), 50) << drift;
    EXPECT_LT(cellAt(*by_image_.last, 1.0, 0.02), 50) << drift << ": floor";
    EXPECT_GE(cellAt(*by_image_.last, 1.0, 0.02), 0) << drift;
  }
}

TEST_F(VoxelMapStage, ATimeJumpBeginsAnew) {
  ASSERT_TRUE(sees(2.02));
  now_ -= 500.0;
  ASSERT_TRUE(askUntil([this] { return came(map_) && cellAt(*map_.last, 2.02, 0.02) != 97; },
                       [&] { next(), cloud_.send(wall(1.02)); }));
  EXPECT_EQ(cellAt(*map_.last, 2.02, 0.02), -1);
  EXPECT_GE(cellAt(*map_.last, 1.02, 0.02), 50);
}

TEST_F(VoxelMapStage, EmptyAndBrokenCloudsAreCountedAndTheNextIsTaken) {
  ASSERT_TRUE(sees(2.02));
  next();
  CloudMessage cloud = wall(2.02);
  for (core::Point& p : cloud.points) p.z = core::kNaN;
  cloud_.send(cloud);
  ASSERT_TRUE(spinUntil([this] { return came(map_); })) << "an answer to every cloud";
  EXPECT_GE(cellAt(*map_.last, 2.02, 0.02), 50) << "and nothing lost";
  next();
  cloud_.send(wall(0.0));
  ASSERT_TRUE(spinUntil([this] { return came(map_); }));
  ASSERT_TRUE(sees(2.02));
}

TEST_F(VoxelMapStage, ACameraThatSeesNothingIsTold) {
  ASSERT_TRUE(sees(2.02));
  EXPECT_TRUE(spinUntil([this] { return says("no usable point"); }, [this] { next(), cloud_.send(wall(0.0)); }));
  EXPECT_TRUE(spinUntil([this] { return !says("no usable point"); }, [this] { next(), cloud_.send(wall(2.02)); }));
}

TEST_F(VoxelMapStage, AStampFromTheFutureCostsNoVoxel) {
  ASSERT_TRUE(sees(2.02));
  CloudMessage late = wall(1.02);
  late.header.stamp = ros::Time::now() + ros::Duration(3600.0);
  cloud_.send(late);
  EXPECT_TRUE(spinUntil([this] { return says("stamp is ahead of the clock: by 3600 s"); }));
  T_map_base_.translation().y() = 3.0;
  next();
  ASSERT_TRUE(sees(2.02));
  EXPECT_GE(cellAt(*map_.last, 2.02, 0.02), 50) << "what was known before";
}

TEST_F(VoxelMapStage, WhoComesLateGetsTheVoxelsAsTheyAre) {
  ASSERT_TRUE(sees(2.02));
  voxels_.leave();
  T_map_base_ = core::Transform(Eigen::Translation3d(0.0, 5.0, 0.0));
  next();
  ASSERT_TRUE(sees(2.02));
  Received<visualization_msgs::MarkerArray> late("voxels");
  EXPECT_TRUE(spinUntil([&] {
    return late.last && std::any_of(late.last->markers[0].points.begin(), late.last->markers[0].points.end(),
                                    [](const auto& p) { return p.y > 4.0; });
  }));
}

TEST_F(VoxelMapStage, IsForgottenWhenAsked) {
  ASSERT_TRUE(sees(2.02));
  std_srvs::Empty reset;
  ASSERT_TRUE(ros::service::call("reset_voxels", reset));
  SaveMap save;
  save.request.file = "/tmp/never.ot";
  ASSERT_TRUE(ros::service::call("save_voxels", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_EQ(save.response.message, "there is no voxel yet");
  next();
  ASSERT_TRUE(sees(1.02));
  EXPECT_EQ(cellAt(*map_.last, 2.02, 0.02), -1);
}

TEST_F(VoxelMapStage, WithoutItsTransformACloudIsDroppedAndItIsSaid) {
  ASSERT_TRUE(sees(2.02));
  now_ += 50.0;
  ASSERT_TRUE(askUntil(
      [this] {
        const auto* status = diagnostics_.of("voxel_map");
        return status && status->level > 0;
      },
      [&] { now_ += 0.1, cloud_.send(wall(2.02)); }));
  ASSERT_TRUE(sees(2.02)) << "and the next with one is taken";
}

TEST_F(VoxelMapStage, ACameraThatIsLostForTenSecondsIsMissedAndItsMapKept) {
  const auto misses = [this] {
    return says("nothing new on points for") &&
           diagnostics_.of("voxel_map")->level == diagnostic_msgs::DiagnosticStatus::WARN;
  };
  ASSERT_TRUE(sees(2.02));
  ASSERT_TRUE(spinUntil(misses));
  now_ += 10.0;
  ASSERT_TRUE(sees(1.02));
  EXPECT_GE(cellAt(*map_.last, 1.02, 0.02), 50);
  EXPECT_GE(cellAt(*map_.last, 2.02, 0.02), 50) << "what was known before";
  EXPECT_TRUE(spinUntil([&] { return !misses(); }, [&] { next(), cloud_.send(wall(1.02)); }));
}

#ifdef FIELD_FUSION_OCTOMAP_MSGS
TEST_F(VoxelMapStage, OctreesSayWhatIsOccupied) {
  Received<octomap_msgs::Octomap> binary("octomap_binary"), full("octomap_full");
  ASSERT_TRUE(spinUntil([&] { return binary.connected() && full.connected(); }));
  ASSERT_TRUE(askUntil([&] { return binary.last && full.last; }, [&] { next(), cloud_.send(wall(2.02)); }));
  for (const auto& message : {binary.last, full.last}) {
    EXPECT_EQ(message->header.frame_id, "map");
    EXPECT_EQ(message->id, "OcTree");
    octomap::OcTree tree(message->resolution);
    std::istringstream data(std::string(message->data.begin(), message->data.end()));
    message->binary ? tree.readBinaryData(data) : tree.readData(data);
    const auto* node = tree.search(2.02, 0.02, 0.32);
    ASSERT_TRUE(node);
    EXPECT_TRUE(tree.isNodeOccupied(node));
    ASSERT_TRUE(node = tree.search(1.02, 0.02, 0.32));
    EXPECT_FALSE(tree.isNodeOccupied(node));
  }
}
#endif

TEST_F(VoxelMapStage, IsSavedAsOctoMapReadsIt) {
  ASSERT_TRUE(sees(2.02));
  const TempFolder folder;
  SaveMap call;
  call.request.file = (folder.path() / "a.bt").string();
  ASSERT_TRUE(ros::service::call("save_voxels", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  octomap::OcTree tree(0.05);
  ASSERT_TRUE(tree.readBinary(call.request.file));
  const auto* node = tree.search(2.02, 0.02, 0.32);
  ASSERT_TRUE(node);
  EXPECT_TRUE(tree.isNodeOccupied(node));
  call.request.file = "/nowhere/a.bt";
  ASSERT_TRUE(ros::service::call("save_voxels", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(call.response.message.find("/nowhere/a.bt"), std::string::npos);
}

}  // namespace
}  // namespace field_fusion::test
