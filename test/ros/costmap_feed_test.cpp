#include "field_fusion/ros/costmap_feed.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include "support/obstacles.h"

namespace field_fusion {
namespace {

const auto kHere = core::Transform::Identity();

/// One cluster of two points at each range, straight ahead.
ClusterArray::ConstPtr clustersAt(double stamp, const std::vector<float>& ranges) {
  auto out = boost::make_shared<ClusterArray>();
  out->header.frame_id = "lidar";
  out->header.stamp.fromSec(stamp);
  for (const float range : ranges) {
    Cluster c;
    c.id = static_cast<std::uint32_t>(out->clusters.size());
    c.first_point = static_cast<std::uint32_t>(out->points.size());
    c.point_count = 2;
    out->clusters.push_back(c);
    geometry_msgs::Point32 p;
    p.x = range;
    out->points.push_back(p);
    p.z = 0.5f;
    out->points.push_back(p);
  }
  return out;
}

Obstacle ofCluster(int cluster, float existence = 0.7f) {
  Obstacle out = test::obstacleAt(Obstacle::SOURCE_LIDAR, 5, 0);
  out.cluster_id = cluster;
  out.existence = existence;
  return out;
}

/// Small enough to be a single point.
Obstacle ofCamera(double range) {
  Obstacle out = test::obstacleAt(Obstacle::SOURCE_CAMERA, range, 0, "boat");
  out.size.x = out.size.y = out.size.z = 0.0;
  out.cluster_id = -1;
  out.existence = 0.7f;
  return out;
}

ObstacleArray obstaclesAt(double stamp, int revision, const std::vector<Obstacle>& obstacles) {
  ObstacleArray out;
  out.header.frame_id = "lidar";
  out.header.stamp.fromSec(stamp);
  out.revision = static_cast<std::uint8_t>(revision);
  out.obstacles = obstacles;
  return out;
}

class Costmap : public testing::Test {
 protected:
  CostmapFeed::Points take(double stamp, int revision, const std::vector<Obstacle>& obstacles) {
    return feed_.take(obstaclesAt(stamp, revision, obstacles), "lidar", kHere);
  }
  /// x of all points that came out; empty where nothing did.
  std::vector<float> places(double stamp, int revision, const std::vector<Obstacle>& obstacles) {
    std::vector<float> out;
    if (const auto cloud = take(stamp, revision, obstacles).cloud)
      for (const auto& p : cloud->points) out.push_back(p.x);
    return out;
  }
  std::string refusal(double stamp, int revision, const std::vector<Obstacle>& obstacles) {
    try {
      take(stamp, revision, obstacles);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }

  CostmapFeed feed_;
};

using Places = std::vector<float>;

TEST_F(Costmap, PointsAreThoseOfTheNamedClustersWithStampAndFrameOfTheOutput) {
  feed_.add(clustersAt(10, {3, 7, 9}));
  core::Transform T = kHere;
  T.translation().z() = 1.0;
  const auto out = feed_.take(obstaclesAt(10, 0, {ofCluster(2), ofCluster(0)}), "base", T);
  ASSERT_TRUE(out.cloud);
  EXPECT_EQ(out.cloud->header.frame_id, "base");
  EXPECT_EQ(out.cloud->header.stamp, ros::Time(10));
  ASSERT_EQ(out.cloud->points.size(), 4u);
  EXPECT_EQ(out.cloud->points[1].position(), Eigen::Vector3f(9, 0, 1.5));
  EXPECT_EQ(out.cloud->points[2].position(), Eigen::Vector3f(3, 0, 1));
  EXPECT_EQ(out.from_lidar, 4u);
}

TEST_F(Costmap, EmptyArraysGiveAnEmptyCloudAndAFreeScan) {
  feed_.add(clustersAt(10, {}));
  const auto out = take(10, 0, {});
  ASSERT_TRUE(out.cloud);
  EXPECT_TRUE(out.cloud->points.empty());
  const auto scan = feed_.scan(out);
  for (const float range : scan->ranges) EXPECT_EQ(range, std::numeric_limits<float>::infinity());
}

TEST_F(Costmap, PartsOfOneClusterCountOnceAndOneSureOneIsEnough) {
  feed_.add(clustersAt(10, {3}));
  EXPECT_EQ(places(10, 0, {ofCluster(0, 0.1f), ofCluster(0, 0.9f)}), (Places{3, 3}));
}

TEST_F(Costmap, PiecesOfOneBodyAllCount) {
  feed_.add(clustersAt(10, {3, 7, 9}));
  Obstacle body = ofCluster(1);
  body.joined_clusters = {2};
  EXPECT_EQ(places(10, 0, {body}), (Places{7, 7, 9, 9}));
  body.joined_clusters = {3};
  EXPECT_EQ(refusal(10, 1, {body}).find("obstacles damaged"), 0u);
}

TEST_F(Costmap, ObstaclesWaitForTheirClusters) {
  const auto obstacles = obstaclesAt(10, 0, {ofCluster(0)});
  EXPECT_FALSE(feed_.ready(obstacles));
  feed_.add(clustersAt(9.9, {3}));
  EXPECT_FALSE(feed_.ready(obstacles));
  feed_.add(clustersAt(10, {3}));
  EXPECT_TRUE(feed_.ready(obstacles));
}

TEST_F(Costmap, MissingAndForeignClustersAreNamed) {
  EXPECT_EQ(refusal(10, 0, {}).find("clusters missing"), 0u);
  EXPECT_EQ(refusal(10, 1, {ofCluster(0)}).find("clusters missing"), 0u);
  feed_.add(clustersAt(10, {3}));
  EXPECT_EQ(refusal(10, 0, {ofCluster(1)}).find("obstacles damaged"), 0u);
}

TEST_F(Costmap, SecondRevisionGoesOutWhenItChangesThePoints) {
  feed_.add(clustersAt(10, {3}));
  EXPECT_EQ(places(10, 0, {ofCluster(0)}), (Places{3, 3}));
  EXPECT_FALSE(take(10, 1, {ofCluster(0, 0.9f)}).cloud);
  feed_.add(clustersAt(11, {3}));
  EXPECT_EQ(places(11, 0, {ofCluster(0)}), (Places{3, 3}));
  EXPECT_EQ(places(11, 1, {ofCluster(0), ofCamera(20)}), (Places{3, 3, 20}));
}

// The camera answers to the clusters of 10.0 s after those of 10.1 s have gone out.
TEST_F(Costmap, LateAnswerOfTheCameraJoinsTheNextPoints) {
  feed_.add(clustersAt(10, {3}));
  feed_.add(clustersAt(10.1, {4}));
  take(10, 0, {ofCluster(0)});
  take(10.1, 0, {ofCluster(0)});
  EXPECT_FALSE(take(10, 1, {ofCluster(0), ofCamera(20)}).cloud);
  feed_.add(clustersAt(10.2, {5}));
  EXPECT_EQ(places(10.2, 0, {ofCluster(0)}), (Places{5, 5, 20}));
}

TEST_F(Costmap, CameraIsRememberedUntilItsNextAnswerOrForCameraMemory) {
  for (const double stamp : {10.0, 10.25, 10.5, 10.75}) feed_.add(clustersAt(stamp, {}));
  take(10, 1, {ofCamera(20)});
  EXPECT_EQ(places(10.25, 0, {}), Places{20});
  EXPECT_EQ(places(10.5, 0, {}), Places{20});
  EXPECT_TRUE(places(10.75, 0, {}).empty());
  take(10.75, 1, {ofCamera(21)});
  feed_.add(clustersAt(10.8, {}));
  EXPECT_TRUE(places(10.8, 1, {}).empty());
}

// DBSCAN leaves out what has too few points; the LiDAR saw it all the same.
TEST_F(Costmap, RaysToPointsThatNoClusterTookAreNotFree) {
  CostmapParams params;
  params.scan.azimuth_step = 1.0;
  feed_.setParams(params);
  auto cloud = boost::make_shared<CloudMessage>();
  cloud->header.stamp.fromSec(10);
  cloud->points.resize(2);
  cloud->points[0].y = 8.f;  // 90 deg
  cloud->points[1].x = 3.f;
  feed_.add(CloudMessage::ConstPtr(cloud));
  feed_.add(clustersAt(10, {3}));
  const auto scan = feed_.scan(take(10, 0, {ofCluster(0)}));
  EXPECT_TRUE(std::isnan(scan->ranges[270]));
  EXPECT_EQ(scan->ranges[180], 3.f);
  EXPECT_EQ(scan->ranges[0], std::numeric_limits<float>::infinity());
}

// Without clusters of the same stamp the LiDAR did not look: nothing may be cleared.
TEST_F(Costmap, CameraWithoutLidarMarksAndLeavesTheRestUnknown) {
  CostmapParams params;
  params.scan.azimuth_step = 1.0;
  feed_.setParams(params);
  const auto out = take(10, 1, {ofCamera(20)});
  ASSERT_TRUE(out.cloud);
  EXPECT_EQ(out.from_lidar, 0u);
  const auto scan = feed_.scan(out);
  std::size_t seen = 0, unknown = 0;
  for (const float range : scan->ranges) seen += range == 20.f, unknown += std::isnan(range);
  EXPECT_EQ(seen, 1u);
  EXPECT_EQ(unknown, scan->ranges.size() - 1);
}

TEST_F(Costmap, ScanTellsItsAnglesAndLimits) {
  CostmapParams params;
  params.scan.azimuth_min = -60, params.scan.azimuth_max = 60, params.scan.azimuth_step = 1;
  params.scan.range_min = 0.5, params.scan.range_max = 40;
  feed_.setParams(params);
  feed_.add(clustersAt(10, {3}));
  const auto scan = feed_.scan(take(10, 0, {ofCluster(0)}));
  EXPECT_EQ(scan->header.stamp, ros::Time(10));
  ASSERT_EQ(scan->ranges.size(), 121u);
  EXPECT_NEAR(scan->angle_min, core::radians(-60), 1e-6);
  EXPECT_NEAR(scan->angle_max, core::radians(60), 1e-6);
  EXPECT_NEAR(scan->angle_increment, core::radians(1), 1e-8);
  EXPECT_EQ(scan->range_min, 0.5f);
  EXPECT_EQ(scan->range_max, 40.f);
  EXPECT_EQ(scan->ranges[60], 3.f);
}

TEST_F(Costmap, ResetForgetsClustersCameraAndStamps) {
  feed_.add(clustersAt(10, {3}));
  take(10, 1, {ofCamera(20)});
  feed_.reset();
  EXPECT_FALSE(feed_.ready(obstaclesAt(10, 0, {ofCluster(0)})));
  feed_.add(clustersAt(5, {4}));
  EXPECT_EQ(places(5, 0, {ofCluster(0)}), (Places{4, 4}));
}

// The bag has looped while nobody listened.
TEST_F(Costmap, ClustersThatDoNotRiseStartAnew) {
  feed_.add(clustersAt(10, {3}));
  take(10, 1, {ofCluster(0), ofCamera(20)});
  feed_.add(clustersAt(9.8, {4}));
  EXPECT_EQ(places(9.8, 0, {ofCluster(0)}), (Places{4, 4}));
}

TEST_F(Costmap, OldClustersAreLetGo) {
  for (int i = 0; i < 100; ++i) feed_.add(clustersAt(10 + 0.1 * i, {3}));
  EXPECT_FALSE(feed_.ready(obstaclesAt(10, 0, {ofCluster(0)})));
  EXPECT_TRUE(feed_.ready(obstaclesAt(10 + 0.1 * 99, 0, {ofCluster(0)})));
}

}  // namespace
}  // namespace field_fusion
