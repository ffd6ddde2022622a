// Obstacles in, markers out.
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include <set>

#include "field_fusion/ObstacleArray.h"
#include "support/obstacles.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

using visualization_msgs::Marker;

class MarkersStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([this] { return obstacles_.connected() && markers_.connected(); }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }
  /// The markers of one array of obstacles.
  bool draws(const std::vector<Obstacle>& obstacles) {
    ObstacleArray array;
    array.header.frame_id = "lidar";
    array.header.stamp.fromSec(now_ += 0.1);
    array.obstacles = obstacles;
    const int before = markers_.count;
    obstacles_.send(array);
    return spinUntil([&] { return markers_.count > before; });
  }
  std::set<std::string> namespacesWith(int action) const {
    std::set<std::string> out;
    for (const auto& m : markers_.last->markers)
      if (m.action == action) out.insert(m.ns);
    return out;
  }

  double now_ = 0.0;
  Received<visualization_msgs::MarkerArray> markers_{"markers"};
  Sender<ObstacleArray> obstacles_{"obstacles"};
  Diagnostics diagnostics_;
};

TEST_F(MarkersStage, DrawsWhatComesAndDeletesWhatWent) {
  ASSERT_TRUE(
      draws({obstacleAt(Obstacle::SOURCE_BOTH, 8, 0, "car"), obstacleAt(Obstacle::SOURCE_LIDAR, 12, 30)}));
  EXPECT_EQ(namespacesWith(Marker::ADD).count("pair"), 1u);
  EXPECT_EQ(namespacesWith(Marker::ADD).count("lidar_alone"), 1u);
  for (const auto& m : markers_.last->markers) EXPECT_EQ(m.header.stamp, ros::Time(now_));
  ASSERT_TRUE(draws({obstacleAt(Obstacle::SOURCE_BOTH, 8, 0, "car")}));
  EXPECT_EQ(namespacesWith(Marker::DELETE),
            (std::set<std::string>{"lidar_alone", "box_alone", "label_alone"}));
  ASSERT_TRUE(draws({}));
  EXPECT_TRUE(namespacesWith(Marker::ADD).empty());
  ASSERT_TRUE(draws({}));
  EXPECT_TRUE(markers_.last->markers.empty());
}

TEST_F(MarkersStage, OnlyTheLastWordOfAnInstantIsDrawn) {
  ObstacleArray array;
  array.header.frame_id = "lidar";
  array.header.stamp.fromSec(now_ += 0.1);
  array.provisional = true;
  array.obstacles = {obstacleAt(Obstacle::SOURCE_LIDAR, 8, 0)};
  const int before = markers_.count;
  obstacles_.send(array);
  array.provisional = false;
  array.revision = 1;  // the stamp is that of revision 0
  array.obstacles = {obstacleAt(Obstacle::SOURCE_BOTH, 8, 0, "car")};
  obstacles_.send(array);
  ASSERT_TRUE(spinUntil([&] { return markers_.count > before; }));
  EXPECT_EQ(namespacesWith(Marker::ADD).count("pair"), 1u);
  EXPECT_EQ(markers_.count, before + 1);
}

TEST_F(MarkersStage, StampZeroIsDroppedAndTheNextDrawn) {
  ObstacleArray array;
  obstacles_.send(array);
  EXPECT_TRUE(
      spinUntil([&] { return !diagnostics_.value("markers", "obstacles: dropped, stamp is zero").empty(); }));
  EXPECT_TRUE(draws({obstacleAt(Obstacle::SOURCE_LIDAR, 12, 30)}));
}

}  // namespace
}  // namespace field_fusion::test
