// Ground and cluster over topics, in one manager: a floor and two posts.
#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/GroundPlane.h"
#include "field_fusion/ros/cloud_message.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

constexpr float kSensorHeight = 1.5f;

void addFloor(core::Cloud& cloud) {
  for (int i = -30; i <= 30; ++i)
    for (int j = -30; j <= 30; ++j) cloud.push_back({0.3f * i, 0.3f * j, -kSensorHeight});
}

/// 0.5 m to 1.45 m above the floor, 20 points.
void addPost(core::Cloud& cloud, float x, float y) {
  for (int i = 0; i < 20; ++i) cloud.push_back({x, y, 0.5f - kSensorHeight + 0.05f * i});
}

CloudMessage message(double stamp, core::Cloud points) {
  CloudMessage out;
  out.header.frame_id = "lidar";
  out.header.stamp.fromSec(stamp);
  out.points = std::move(points);
  return out;
}

class ClusterStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([this] { return in_.connected() && clusters_.connected() && plane_.connected(); }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }
  /// Sends the cloud under rising stamps until it is answered.
  bool answers(const core::Cloud& cloud) {
    const int before = clusters_.count, planes = plane_.count;
    return spinUntil([&] { return clusters_.count > before && plane_.count > planes; },
                     [&] { in_.send(message(now_ += 0.1, cloud)); });
  }

  double now_ = 0.0;
  Sender<CloudMessage> in_{"points"};
  Received<ClusterArray> clusters_{"clusters"};
  Received<GroundPlane> plane_{"ground_plane"};
  Diagnostics diagnostics_;
};

TEST_F(ClusterStage, PostsOnAFloorBecomeClustersWithBoxRangeAndAzimuth) {
  core::Cloud cloud;
  addFloor(cloud);
  addPost(cloud, 3.f, 0.f);
  addPost(cloud, 0.f, 5.f);
  ASSERT_TRUE(answers(cloud));
  EXPECT_EQ(clusters_.last->header.frame_id, "lidar");
  ASSERT_EQ(clusters_.last->clusters.size(), 2u);
  const auto& near = clusters_.last->clusters[0];
  EXPECT_EQ(near.point_count, 20u);
  EXPECT_NEAR(near.min.z, 0.5 - kSensorHeight, 1e-5);
  EXPECT_NEAR(near.max.z, 1.45 - kSensorHeight, 1e-5);
  const double middle = 0.975 - kSensorHeight;
  EXPECT_NEAR(near.range, std::hypot(3.0, middle), 1e-5);
  EXPECT_NEAR(near.azimuth, 0.0, 1e-6);
  const auto& left = clusters_.last->clusters[1];
  EXPECT_NEAR(left.azimuth, core::radians(90.0), 1e-6);
  const auto& point = clusters_.last->points.at(left.first_point);
  EXPECT_NEAR(point.y, 5.f, 1e-6);
}

TEST_F(ClusterStage, PlaneIsThatOfTheFloor) {
  core::Cloud cloud;
  addFloor(cloud);
  ASSERT_TRUE(answers(cloud));
  EXPECT_TRUE(plane_.last->found);
  EXPECT_NEAR(plane_.last->normal.z, 1.0, 1e-6);
  EXPECT_NEAR(plane_.last->height, kSensorHeight, 1e-5);
  EXPECT_EQ(plane_.last->fault, "");
}

TEST_F(ClusterStage, WithoutGroundTheCloudGoesOnAndItIsSaid) {
  core::Cloud cloud;
  addPost(cloud, 3.f, 0.f);
  ASSERT_TRUE(answers(cloud));
  EXPECT_FALSE(plane_.last->found);
  EXPECT_NE(plane_.last->fault, "");
  EXPECT_TRUE(std::isnan(plane_.last->height));
  EXPECT_EQ(clusters_.last->clusters.size(), 1u);
  EXPECT_TRUE(spinUntil([&] { return diagnostics_.says("ground", "no ground"); }));
}

TEST_F(ClusterStage, EmptyOnePointAndAllNanGiveEmptyArrays) {
  for (const auto& cloud : {core::Cloud{}, core::Cloud{{1.f, 1.f, 1.f}},
                            core::Cloud(500, {core::kNaN, core::kNaN, core::kNaN})}) {
    ASSERT_TRUE(answers(cloud));
    EXPECT_TRUE(clusters_.last->clusters.empty());
    EXPECT_TRUE(clusters_.last->points.empty());
  }
}

TEST_F(ClusterStage, AllPointsEqualMakeOneCluster) {
  ASSERT_TRUE(answers(core::Cloud(5000, {4.f, 0.f, 0.f})));
  ASSERT_EQ(clusters_.last->clusters.size(), 1u);
  EXPECT_EQ(clusters_.last->clusters[0].point_count, 5000u);
}

}  // namespace
}  // namespace field_fusion::test
