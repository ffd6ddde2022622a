// Clusters and obstacles over topics. The LiDAR stands 1.5 m above `base` (costmap.test).
#include <gtest/gtest.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ros/vision_output.h"
#include "support/obstacles.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

class CostmapStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([this] {
      return clusters_.connected() && obstacles_.connected() && points_.connected() && scan_.connected();
    }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  /// One cluster 5 m ahead: a point on the water, one 1 m above it.
  ClusterArray clusters() const {
    ClusterArray out;
    out.header = header();
    out.clusters.resize(1);
    out.clusters[0].point_count = 2;
    out.clusters[0].box_yaw = NAN;
    out.clusters[0].box_centre.x = out.clusters[0].box_centre.y = out.clusters[0].box_centre.z = NAN;
    out.clusters[0].box_size.x = out.clusters[0].box_size.y = out.clusters[0].box_size.z = NAN;
    out.points.resize(2);
    out.points[0].x = out.points[1].x = 5.f;
    out.points[0].z = -1.5f, out.points[1].z = -0.5f;
    return out;
  }
  ObstacleArray obstacles(int cluster = 0) const {
    ObstacleArray out;
    out.header = header();
    out.obstacles = {obstacleAt(Obstacle::SOURCE_BOTH, 5, 0, "boat")};
    out.obstacles[0].cluster_id = cluster;
    out.obstacles[0].existence = 0.9f;
    return out;
  }
  std_msgs::Header header() const {
    std_msgs::Header out;
    out.frame_id = "lidar";
    out.stamp.fromSec(now_);
    return out;
  }
  bool answered() {
    const auto now = [this](const auto& out) {
      return out.last && out.last->header.stamp == ros::Time(now_);
    };
    return spinUntil([&] { return now(points_) && now(scan_); });
  }
  /// Sends until an answer comes: then all that is needed is there.
  bool works() {
    const int before = points_.count;
    return spinUntil([&] { return points_.count > before; },
                     [this] {
                       now_ += 0.1;
                       clusters_.send(clusters());
                       obstacles_.send(obstacles());
                     });
  }
  bool reports(const std::string& what) {
    return spinUntil([&] { return !diagnostics_.value("costmap", what).empty(); });
  }

  double now_ = 0.0;
  Received<sensor_msgs::PointCloud2> points_{"obstacle_points"};
  Received<sensor_msgs::LaserScan> scan_{"obstacle_scan"};
  Sender<ClusterArray> clusters_{"clusters"};
  Sender<ObstacleArray> obstacles_{"obstacles"};
  Diagnostics diagnostics_;
};

TEST_F(CostmapStage, PointsAndScanStandInTheWantedFrameWithinTheBand) {
  ASSERT_TRUE(works());
  ASSERT_TRUE(answered());
  EXPECT_EQ(points_.last->header.frame_id, "base");
  ASSERT_EQ(points_.last->width * points_.last->height, 1u);
  EXPECT_FLOAT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(*points_.last, "x"), 5.f);
  EXPECT_FLOAT_EQ(*sensor_msgs::PointCloud2ConstIterator<float>(*points_.last, "z"), 1.f);
  EXPECT_EQ(scan_.last->header.frame_id, "base");
  ASSERT_EQ(scan_.last->ranges.size(), 1440u);
  EXPECT_FLOAT_EQ(scan_.last->ranges[720], 5.f);
  EXPECT_EQ(scan_.last->ranges[0], std::numeric_limits<float>::infinity());
}

TEST_F(CostmapStage, ObstaclesThatComeFirstWaitForTheirClusters) {
  ASSERT_TRUE(works());
  now_ += 0.1;
  obstacles_.send(obstacles());
  clusters_.send(clusters());
  EXPECT_TRUE(answered());
}

TEST_F(CostmapStage, ClustersThatNeverComeAreCounted) {
  ASSERT_TRUE(works());
  now_ += 0.1;
  obstacles_.send(obstacles());
  EXPECT_TRUE(reports("obstacles: dropped, clusters missing"));
  EXPECT_TRUE(works());
}

TEST_F(CostmapStage, ObstaclesOfOtherClustersAreDamaged) {
  ASSERT_TRUE(works());
  now_ += 0.1;
  clusters_.send(clusters());
  obstacles_.send(obstacles(7));
  EXPECT_TRUE(reports("obstacles: dropped, obstacles damaged"));
  EXPECT_TRUE(works());
}

TEST_F(CostmapStage, LoopingBagIsATimeJumpAndGoesOn) {
  ASSERT_TRUE(works());
  now_ -= 60.0;
  ASSERT_TRUE(works());
  EXPECT_LT(points_.last->header.stamp.toSec(), now_ + 1.0);
}

#ifdef FIELD_FUSION_VISION_MSGS
TEST_F(CostmapStage, DetectionsSayClassPlaceAndSize) {
  Received<vision_msgs::Detection3DArray> detections("obstacle_detections");
  ASSERT_TRUE(works());
  ASSERT_TRUE(spinUntil([&] { return detections.last != nullptr; }, [this] { works(); }));
  EXPECT_EQ(detections.last->header.frame_id, "lidar");
  ASSERT_EQ(detections.last->detections.size(), 1u);
  const auto& d = detections.last->detections[0];
  EXPECT_EQ(d.results.at(0).id, 1);  // boat
  EXPECT_EQ(d.results.at(0).score, 0.5);
  EXPECT_EQ(d.bbox.center.position.x, 5.0);
  EXPECT_EQ(d.bbox.size.x, 1.0);
}
#endif

}  // namespace
}  // namespace field_fusion::test
