// A room seen over topics: scanner 0.3 m ahead, odometry that drifts, and what goes wrong on a robot.
#include <gtest/gtest.h>

#include <nav_msgs/GetMap.h>
#include <nav_msgs/Path.h>
#include <geometry_msgs/PoseArray.h>
#include <std_msgs/Float64.h>

#include "field_fusion/SaveMap.h"
#include "field_fusion/core/io/map_file.h"
#include "support/frames.h"
#include "support/room_robot.h"
#include "support/stage_probe.h"
#include "support/temp_folder.h"

namespace field_fusion::test {
namespace {

class GridSlamStage : public testing::Test {
 protected:
  void SetUp() override {
    core::Transform upside = core::Transform::Identity();  // upside down and turned to the left
    upside.translation() << 0.3, 0.0, 0.4;
    upside.linear() = (Eigen::AngleAxisd(core::radians(90.0), Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(core::radians(180.0), Eigen::Vector3d::UnitX())).toRotationMatrix();
    frames_.sendStatic("base", "laser", core::Transform(Eigen::Translation3d(0.3, 0.0, 0.4)));
    frames_.sendStatic("base", "upside", upside);
    ASSERT_TRUE(spinUntil([this] { return scan_.connected() && map_.connected() && path_.connected(); }));
  }

  sensor_msgs::LaserScan scan(const std::string& frame, int beams = 360) const { return robot_.scan(frame, beams); }
  void send(const sensor_msgs::LaserScan& message) {
    frames_.send(now_, "odom", "base", solid(odom_));
    scan_.send(message);
  }
  bool taken() {
    return spinUntil([this] { return map_.last && map_.last->header.stamp == ros::Time(now_); });
  }
  /// Until the stage has a map of now: of the test before, or a new one after time jumped back, which clears everything.
  bool begins(const std::string& frame = "laser") {
    int tries = 0;
    return askUntil([this] { return map_.last && map_.last->header.stamp == ros::Time(now_); },
                    [&] { now_ += tries++ % 2 == 0 ? -1000.0 : 0.1, send(scan(frame)); });
  }
  bool steps(int count, const std::string& frame = "laser", int beams = 360) {
    for (int i = 0; i < count; ++i) {
      robot_.walk(), send(scan(frame, beams));
      if (!taken()) return false;
    }
    return true;
  }
  /// [m] of the robot, by the transforms, from where it truly is. The map begins where odometry was right.
  double off() {
    if (!spinUntil([this] { return frames_.knows(now_, "map", "base"); })) return HUGE_VAL;
    return (frames_.at(now_, "map", "base").translation().head<2>() - truth_.position()).norm();
  }
  int cellAt(double x, double y) const {
    const auto& info = map_.last->info;
    const int u = static_cast<int>((x - info.origin.position.x) / info.resolution);
    const int v = static_cast<int>((y - info.origin.position.y) / info.resolution);
    return map_.last->data.at(static_cast<std::size_t>(v) * info.width + u);
  }
  int wallsNear(double x, double y) const {  // within two cells
    int walls = 0;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) walls += cellAt(x + 0.05 * i, y + 0.05 * j) == 100;
    return walls;
  }

  static inline RoomRobot robot_;  // walks on from test to test, as the stage lives on: it must not leap
  double& now_ = robot_.now;
  core::Pose2 &truth_ = robot_.truth, &odom_ = robot_.odom;
  Frames frames_;
  Sender<sensor_msgs::LaserScan> scan_{"scan"};
  Received<nav_msgs::OccupancyGrid> map_{"map"}, local_{"local_map"};
  Received<nav_msgs::MapMetaData> meta_{"map_metadata"};
  Received<nav_msgs::Path> path_{"path"};
  Received<geometry_msgs::PoseArray> particles_{"particles"};
  Received<std_msgs::Float64> entropy_{"grid_slam/entropy"};
  Diagnostics diagnostics_;
};

TEST_F(GridSlamStage, MapsTheRoomAndCorrectsOdometry) {
  ASSERT_TRUE(begins());
  ASSERT_TRUE(steps(40));
  EXPECT_GT((odom_.position() - truth_.position()).norm(), 0.05) << "or there was nothing to do";
  EXPECT_LT(off(), 0.05);
  EXPECT_EQ(map_.last->header.frame_id, "map");
  EXPECT_GT(wallsNear(5.0, 0.0), 0);
  EXPECT_GT(wallsNear(0.0, 2.0), 0);
  EXPECT_EQ(cellAt(0.0, -1.0), 0);
  ASSERT_TRUE(spinUntil([this] { return path_.last && path_.last->poses.size() >= 41 && entropy_.last && local_.last; }));
  EXPECT_EQ(particles_.last->poses.size(), 8u);
  EXPECT_LE(entropy_.last->data, std::log(8.0) + 1e-9);
  EXPECT_EQ(meta_.last->width, map_.last->info.width);
  EXPECT_EQ(local_.last->info.width, 200u) << "10 m";
  EXPECT_NEAR(local_.last->info.origin.position.x + 5.0, truth_.x, 0.1);
}

TEST_F(GridSlamStage, ServicesGiveAndSaveTheMap) {
  const TempFolder folder;
  SaveMap save;
  save.request.file = (folder.path() / "a.yaml").string();
  ASSERT_TRUE(begins());
  ASSERT_TRUE(ros::service::call("save_map", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  nav_msgs::GetMap get;
  ASSERT_TRUE(ros::service::call("dynamic_map", get));
  EXPECT_EQ(get.response.map.data, map_.last->data);
  EXPECT_EQ(core::readMap(folder.path() / "a.yaml").cells, map_.last->data);
  save.request.file = "a.yaml";
  ASSERT_TRUE(ros::service::call("save_map", save));
  EXPECT_FALSE(save.response.success) << "where the node happens to be";
  EXPECT_NE(save.response.message.find("does not begin at /"), std::string::npos) << save.response.message;
  save.request.file = "/nowhere/a.yaml";
  ASSERT_TRUE(ros::service::call("save_map", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_NE(save.response.message.find("/nowhere/a.pgm"), std::string::npos) << save.response.message;
}

TEST_F(GridSlamStage, ScannerUpsideDownAndTurned) {
  ASSERT_TRUE(begins("upside"));
  ASSERT_TRUE(steps(15, "upside"));
  EXPECT_LT(off(), 0.05);
}

TEST_F(GridSlamStage, ScansOfAnotherSizeAndBlindOnes) {
  ASSERT_TRUE(begins());
  ASSERT_TRUE(steps(5));
  ASSERT_TRUE(steps(5, "laser", 181));
  robot_.walk();
  auto blind = scan("laser");
  std::fill(blind.ranges.begin(), blind.ranges.end(), core::kFree);
  send(blind);
  EXPECT_LT(off(), 0.1) << "odometry goes on";
  EXPECT_TRUE(spinUntil([&] { return diagnostics_.says("grid_slam", "the last scan has no return"); }));
  auto damaged = (robot_.walk(), scan("laser"));
  damaged.range_max = -1.f;
  send(damaged);
  EXPECT_TRUE(spinUntil([&] { return !diagnostics_.value("grid_slam", "scan: dropped, scan damaged").empty(); }));
  ASSERT_TRUE(steps(3));
  EXPECT_LT(off(), 0.05);
}

TEST_F(GridSlamStage, AJumpOfOdometryIsNoMotion) {
  ASSERT_TRUE(begins());
  ASSERT_TRUE(steps(5));
  odom_.x += 10.0;
  robot_.walk(), send(scan("laser"));  // its own step is lost: it is not yet due
  ASSERT_TRUE(steps(5));
  EXPECT_LT(off(), 0.06);
  EXPECT_TRUE(spinUntil([&] { return diagnostics_.value("grid_slam", "jumps of the odometry") == "1"; }));
}

TEST_F(GridSlamStage, CarriedElsewhereItSaysSoAndGoesOn) {
  const Sender<sensor_msgs::LaserScan> scan("carried/scan");  // a stage of its own, with nothing of the tests before
  const Received<nav_msgs::OccupancyGrid> map("carried/map");
  const auto walks = [&] {
    return askUntil([&, before = map.count] { return map.count > before; }, [&] {
      robot_.walk();
      frames_.send(now_, "odom", "base", solid(odom_));
      scan.send(this->scan("laser"));
    });
  };
  ASSERT_TRUE(spinUntil([&] { return scan.connected() && map.connected(); }));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(walks()) << i;
  ASSERT_TRUE(spinUntil([&] { return diagnostics_.value("carried/slam", "scans that did not fit it") == "0"; }));
  truth_ = core::Pose2{-2.5, 1.0, truth_.yaw + 2.0};  // by hand: odometry does not see it
  ASSERT_TRUE(walks());
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics_.says("carried/slam", "has the robot been carried") &&
           diagnostics_.of("carried/slam")->level == diagnostic_msgs::DiagnosticStatus::WARN;
  }));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(walks()) << "it goes on";
}

TEST_F(GridSlamStage, MissingTransformIsNamedAndABagMayLoop) {
  ASSERT_TRUE(begins());
  robot_.walk();
  scan_.send(scan("nowhere"));
  EXPECT_TRUE(spinUntil([&] { return !diagnostics_.value("grid_slam", "scan: dropped, no transform").empty(); }));
  ASSERT_TRUE(begins());
  ASSERT_TRUE(spinUntil([this] { return path_.last && path_.last->header.stamp == ros::Time(now_); }));
  EXPECT_EQ(path_.last->poses.size(), 1u) << "the map is a new one";
}

TEST_F(GridSlamStage, AStampFromTheFutureCostsNoMap) {
  ASSERT_TRUE(begins());
  ASSERT_TRUE(steps(8));
  ASSERT_TRUE(spinUntil([this] { return path_.last && path_.last->header.stamp == ros::Time(now_); }));
  const std::size_t before = path_.last->poses.size();
  const ros::Time last = path_.last->header.stamp;
  auto late = scan("laser");
  late.header.stamp += ros::Duration(1000.0);
  scan_.send(late);
  ASSERT_TRUE(askUntil([&] { return path_.last->header.stamp == ros::Time(now_) && path_.last->header.stamp > last; },
                       [&] { robot_.walk(), send(scan("laser")); }));
  EXPECT_GT(path_.last->poses.size(), before);
}

TEST_F(GridSlamStage, AScannerOutOfThePlaneIsRefused) {
  core::Transform upright = core::Transform::Identity();
  upright.linear() = Eigen::AngleAxisd(core::radians(90.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  frames_.sendStatic("base", "upright", upright);
  ASSERT_TRUE(begins());
  robot_.walk(), send(scan("upright"));
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics_.says("grid_slam", "the scanner upright is tilted by 90 deg");
  }));
}

}  // namespace
}  // namespace field_fusion::test
