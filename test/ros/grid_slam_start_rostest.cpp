// What is told to the stage before it starts: a map to go on from, whether and when to send its transform, other names.
#include <gtest/gtest.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>

#include "field_fusion/core/io/map_file.h"
#include "field_fusion/core/map/scan_insertion.h"
#include "support/frames.h"
#include "support/room_robot.h"
#include "support/stage_probe.h"
#include "support/temp_folder.h"

namespace field_fusion::test {
namespace {

class GridSlamStart : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("manager/load_nodelet", ros::Duration(20)));
    frames_.sendStatic("base", "laser", core::Transform(Eigen::Translation3d(RoomRobot::kAhead, 0.0, 0.4)));
    set("particles", 8), set("map_update_interval", 0.0), set("hold_limit", 1.5);
    set("linear_update", 0.05);
  }
  void TearDown() override {
    nodelet::NodeletUnload call;
    call.request.name = "/grid_slam";
    EXPECT_TRUE(ros::service::call("manager/unload_nodelet", call) && call.response.success);
    ros::param::del("/grid_slam");
    start_ = robot_.now + 1000.0;
  }

  template <class T>
  void set(const std::string& name, const T& value) {
    ros::param::set("/grid_slam/" + name, value);
  }
  void load() {
    nodelet::NodeletLoad call;
    call.request.name = "/grid_slam", call.request.type = "field_fusion/grid_slam";
    ASSERT_TRUE(ros::service::call("manager/load_nodelet", call) && call.response.success);
    ASSERT_TRUE(spinUntil([this] { return scan_.connected() && map_.connected() && path_.connected(); }));
  }
  void send() {
    frames_.send(robot_.now, "odom", "base", solid(robot_.odom));
    scan_.send(robot_.scan("laser"));
  }
  bool taken() {
    return spinUntil([this] { return map_.last && map_.last->header.stamp == ros::Time(robot_.now); });
  }
  /// Until the first scan is taken in, which may come before its transform's listener is up.
  bool begins() {
    return askUntil([this] { return map_.last && map_.last->header.stamp == ros::Time(robot_.now); },
                    [this] { robot_.now += 0.1, send(); });
  }
  int cellAt(double x, double y) const {
    const auto& info = map_.last->info;
    const int u = static_cast<int>((x - info.origin.position.x) / info.resolution);
    const int v = static_cast<int>((y - info.origin.position.y) / info.resolution);
    return map_.last->data.at(static_cast<std::size_t>(v) * info.width + u);
  }

  static inline double start_ = 2e6;
  RoomRobot robot_{start_};
  Frames frames_;
  Sender<sensor_msgs::LaserScan> scan_{"/scan"};
  Received<nav_msgs::OccupancyGrid> map_{"/map"};
  Received<nav_msgs::Path> path_{"/path"};
};

/// The room as a file, with one wall cell at (8.02, 8.02) that no scan will ever show.
std::string roomFile(const TempFolder& folder) {
  core::TileMap map;
  core::ScanInsertion insertion;
  for (const core::Pose2& at : {core::Pose2{0.0, -1.0, 0.0}, {1.0, -1.5, 1.0}, {-2.0, 1.0, 2.0}})
    insertion.insert(roomScan(at), at, 0.05, 1, map);
  core::Occupancy picture = core::OccupancyDrawer(0.05).update(map);
  picture = core::occupancyAbout(map, 0.05, 0.0, 0.0, 24.0);
  const auto mark = static_cast<std::size_t>(std::floor((8.02 - picture.y) / 0.05) * picture.width + std::floor((8.02 - picture.x) / 0.05));
  picture.cells.at(mark) = core::kWallCell;
  const auto file = folder.path() / "room.yaml";
  core::writeMap(file, picture);
  return file.string();
}

TEST_F(GridSlamStart, GoesOnInTheMapOfAFile) {
  const TempFolder folder;
  set("map_file", roomFile(folder)), set("tf_delay", 0.0);
  const core::Pose2 told = robot_.truth * core::Pose2{0.15, -0.1, 0.08};
  set("start_x", told.x), set("start_y", told.y), set("start_yaw", core::degrees(told.yaw));
  robot_.odom = {50.0, 20.0, 1.0};  // its own origin
  load();
  ASSERT_TRUE(begins());
  const auto off = [this] {
    if (!spinUntil([this] { return frames_.knows(robot_.now, "map", "base"); })) return HUGE_VAL;
    return (frames_.at(robot_.now, "map", "base").translation().head<2>() - robot_.truth.position()).norm();
  };
  EXPECT_LT(off(), 0.05) << "the first scan has put it right";
  EXPECT_EQ(cellAt(8.02, 8.02), 100) << "of the file alone";
  for (int i = 0; i < 10; ++i) {
    robot_.walk(), send();
    ASSERT_TRUE(taken());
  }
  EXPECT_LT(off(), 0.05);
  EXPECT_EQ(cellAt(8.02, 8.02), 100);
}

TEST_F(GridSlamStart, SendsNoTransformWhereAnotherDoes) {
  Received<tf2_msgs::TFMessage> tf("/tf");
  int maps = 0;
  set("publish_tf", false);
  load();
  ASSERT_TRUE(begins());
  for (int i = 0; i < 5; ++i) {
    robot_.walk(), send();
    ASSERT_TRUE(spinUntil([&] {
      if (tf.last) maps += tf.last->transforms.at(0).header.frame_id == "map";
      return map_.last->header.stamp == ros::Time(robot_.now);
    }));
  }
  EXPECT_TRUE(tf.last) << "those of the odometry";
  EXPECT_EQ(maps, 0);
  EXPECT_FALSE(frames_.knows(robot_.now, "map", "odom"));
}

TEST_F(GridSlamStart, ATransformHoldsFromItsDelayOn) {
  set("tf_delay", 0.25);
  load();
  ASSERT_TRUE(begins());
  const double first = robot_.now;
  ASSERT_TRUE(spinUntil([&] { return frames_.knows(first + 0.25, "map", "odom"); }));
  EXPECT_FALSE(frames_.knows(first, "map", "odom")) << "nothing was known before";
  for (int i = 0; i < 10; ++i) {
    robot_.walk(), send();
    ASSERT_TRUE(taken());
  }
  ASSERT_TRUE(spinUntil([&] { return frames_.knows(robot_.now + 0.25, "map", "odom"); }));
  EXPECT_FALSE(frames_.knows(robot_.now + 0.26, "map", "odom")) << "nor what comes";
  ASSERT_TRUE(frames_.knows(robot_.now, "map", "base")) << "a scan finds its place at its own stamp";
  const double off = (frames_.at(robot_.now, "map", "base").translation().head<2>() - robot_.truth.position()).norm();
  EXPECT_LT(off, 0.05) << "by the correction of three scans before";
}

TEST_F(GridSlamStart, ThereIsNoMapBeforeTheFirstScan) {
  load();
  nav_msgs::GetMap get;
  ASSERT_TRUE(ros::service::waitForService("dynamic_map", ros::Duration(20)));
  EXPECT_FALSE(ros::service::call("dynamic_map", get)) << "rather than a map without cells";
  ASSERT_TRUE(begins());
  EXPECT_TRUE(ros::service::call("dynamic_map", get));
}

TEST_F(GridSlamStart, AnglesByOtherNamesAreRadians) {
  ros::param::del("/grid_slam/linear_update");
  set("linearUpdate", 10.0), set("angularUpdate", 0.1);  // 5.7 degrees
  load();
  ASSERT_TRUE(begins());
  for (int i = 0; i < 2; ++i) {  // two turns of 3.4 degrees: the second is due
    robot_.now += 0.1;
    robot_.truth.yaw += 0.06, robot_.odom.yaw += 0.06;
    send();
  }
  ASSERT_TRUE(taken());
  ASSERT_TRUE(spinUntil([this] { return path_.last && path_.last->header.stamp == ros::Time(robot_.now); }));
  EXPECT_EQ(path_.last->poses.size(), 2u);
}

}  // namespace
}  // namespace field_fusion::test
