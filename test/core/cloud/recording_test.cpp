// Ground and clusters of a real drive, where FIELD_FUSION_DATA names the recordings.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "field_fusion/core/cloud/cluster.h"
#include "field_fusion/core/cloud/ground.h"
#include "field_fusion/core/io/kitti.h"
#include "support/temp_folder.h"

namespace field_fusion::core {
namespace {

struct Recording : testing::Test {
  void SetUp() override {
    if (test::recording("").empty()) GTEST_SKIP() << "FIELD_FUSION_DATA is not set";
  }
  Ground part(const Cloud& cloud, double stamp) { return finder.run(cloud, stamp, ground, obstacles); }

  GroundFinder finder;
  Cloud ground, obstacles;
};

/// The body in the own lane, 5 to 15 m ahead, with the most points.
const Cluster& carAhead(const Clusters& found) {
  const auto points = [](const Cluster& c) {
    const bool ahead = c.centre.x() > 5.f && c.centre.x() < 15.f && std::abs(c.centre.y()) < 1.5f;
    return ahead ? c.points.count : 0;
  };
  return *std::max_element(found.clusters.begin(), found.clusters.end(),
                           [&](const Cluster& a, const Cluster& b) { return points(a) < points(b); });
}

/// [m] along x to the rear: the x that one in a hundred points stays below, because a few returns from the
/// road in front of the bumper belong to the cluster.
float rearOf(const Cluster& car, const Clusters& found) {
  std::vector<float> xs;
  for (std::uint32_t i = 0; i < car.points.count; ++i) xs.push_back(found.points[car.points.first + i].x);
  std::sort(xs.begin(), xs.end());
  return xs[xs.size() / 100];
}

TEST_F(Recording, RoadGoesAndTheCarAheadStaysWhereItIs) {
  const std::map<std::size_t, float> rear{{0, 7.98f}, {1, 7.92f}, {5, 7.69f}, {9, 7.43f}};
  const auto frames = listKitti(test::recording("kitti_sequence"));
  ASSERT_EQ(frames.size(), 10u);
  Clusterer clusterer;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Ground result = part(readKittiCloud(frames[i].cloud), 0.1 * static_cast<double>(i));
    ASSERT_TRUE(result.found()) << describe(result.fault);
    EXPECT_NEAR(result.plane.offset, 1.73, 0.1);  // where KITTI's sensor is mounted
    EXPECT_LT(result.tilt, radians(2.0));
    const Clusters& found = clusterer.run(obstacles);
    const Cluster& car = carAhead(found);
    EXPECT_GT(car.points.count, 700u) << "frame " << i;
    EXPECT_NEAR(car.box.sizes().y(), 1.7f, 0.15f) << "frame " << i;
    const auto truth = rear.find(i);
    if (truth == rear.end()) continue;
    EXPECT_NEAR(rearOf(car, found), truth->second, 0.05f) << "frame " << i;
  }
}

TEST_F(Recording, PlaneStaysTheRoadInEveryFrameOfTheDrive) {
  const auto frames = listKitti(test::recording("kitti_tracking"));
  ASSERT_EQ(frames.size(), 80u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Ground result = part(readKittiCloud(frames[i].cloud), 0.1 * static_cast<double>(i));
    ASSERT_TRUE(result.found()) << "frame " << i << ": " << describe(result.fault);
    EXPECT_NEAR(result.plane.offset, 1.73, 0.15) << "frame " << i;
    EXPECT_LT(result.tilt, radians(3.0)) << "frame " << i;
    EXPECT_GT(result.confidence, 0.9) << "frame " << i;
  }
}

}  // namespace
}  // namespace field_fusion::core
