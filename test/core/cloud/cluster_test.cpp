#include "field_fusion/core/cloud/cluster.h"

#include <gtest/gtest.h>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

ClusterParams params(double epsilon, int min_points, int max_points = 20000) {
  ClusterParams out;
  out.method = ClusterMethod::kDbscan;
  out.epsilon = epsilon, out.min_points = min_points, out.max_points = max_points;
  return out;
}

TEST(Clusterer, FindsNothingInAnEmptyCloud) {
  Clusterer clusterer;
  const Clusters& result = clusterer.run({});
  EXPECT_TRUE(result.clusters.empty());
  EXPECT_TRUE(result.points.empty());
  EXPECT_TRUE(result.labels.empty());
}

TEST(Clusterer, BoxCentreAndPolarFollowEquations8To11) {
  Clusterer clusterer(params(5.0, 1));
  const Clusters& result = clusterer.run({at(2, 3, -1), at(4, 5, 1), at(2.5f, 4.5f, 5)});
  ASSERT_EQ(result.clusters.size(), 1u);
  const Cluster& body = result.clusters[0];
  EXPECT_EQ(body.box.min(), Eigen::Vector3f(2, 3, -1));
  EXPECT_EQ(body.box.max(), Eigen::Vector3f(4, 5, 5));
  EXPECT_EQ(body.centre, Eigen::Vector3f(3, 4, 2));  // not the mean of the points
  EXPECT_DOUBLE_EQ(body.polar.range, std::sqrt(29.0));
  EXPECT_DOUBLE_EQ(body.polar.azimuth, std::atan2(4.0, 3.0));
  EXPECT_DOUBLE_EQ(body.polar.elevation, std::atan2(2.0, 5.0));
  EXPECT_FLOAT_EQ(body.nearest_range, std::sqrt(14.f));
}

TEST(Clusterer, AzimuthIsPositiveToTheLeft) {
  Clusterer clusterer(params(0.5, 1));
  EXPECT_DOUBLE_EQ(clusterer.run({at(0, 2)}).clusters[0].polar.azimuth, radians(90.0));
  EXPECT_DOUBLE_EQ(clusterer.run({at(-1, -1)}).clusters[0].polar.azimuth, radians(-135.0));
}

TEST(Clusterer, OrdersByNearestRangeThenByPlaceInTheCloud) {
  Clusterer clusterer(params(0.5, 1));
  const Clusters& result = clusterer.run({at(9, 0), at(0, 5), at(5, 0), at(-2, 0)});
  ASSERT_EQ(result.clusters.size(), 4u);
  EXPECT_EQ(result.labels, (std::vector<int>{3, 1, 2, 0}));
  EXPECT_EQ(result.clusters[1].centre, Eigen::Vector3f(0, 5, 0));
}

TEST(Clusterer, GroupsWholePointsByClusterInTheOrderOfTheCloud) {
  Cloud cloud{at(5, 0), at(1, 0), at(5.1f, 0), at(1.1f, 0), at(30, 0)};
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud[i].ring = static_cast<std::uint16_t>(i);
  Clusterer clusterer(params(0.5, 2));
  const Clusters& result = clusterer.run(cloud);
  ASSERT_EQ(result.clusters.size(), 2u);
  std::vector<int> rings;
  for (const Point& p : result.points) rings.push_back(p.ring);
  EXPECT_EQ(rings, (std::vector<int>{1, 3, 0, 2}));
  EXPECT_EQ(result.clusters[1].points.first, 2u);
  EXPECT_EQ(result.clusters[1].points.count, 2u);
  EXPECT_EQ(result.noise, 1u);
}

TEST(Clusterer, LeavesOutAndCountsWhatIsTooLarge) {
  const Cloud cloud = test::join({test::line(6, 0.1f), test::line(5, 0.1f, 4.f)});
  Clusterer clusterer(params(0.5, 2, 5));
  const Clusters& result = clusterer.run(cloud);
  EXPECT_EQ(result.too_large, 1u);
  EXPECT_EQ(result.noise, 0u);
  ASSERT_EQ(result.clusters.size(), 1u);
  EXPECT_EQ(result.points.size(), 5u);
  EXPECT_EQ(result.labels, (std::vector<int>{-1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0}));
}

TEST(Clusterer, CountsUnusablePointsApartFromNoise) {
  Clusterer clusterer(params(0.5, 2));
  const Clusters& result = clusterer.run({at(kNaN, 0), at(1, 0), at(0, INFINITY), at(5, 0), at(5, 0.1f)});
  EXPECT_EQ(result.unusable, 2u);
  EXPECT_EQ(result.noise, 1u);
  EXPECT_EQ(result.clusters.size(), 1u);
}

TEST(Clusterer, KeepsNothingOfTheCloudBefore) {
  Clusterer clusterer(params(0.5, 2));
  clusterer.run(test::join({test::line(6, 0.1f), test::line(5, 0.1f, 4.f), {at(kNaN, 0), at(50, 0)}}));
  const Clusters& result = clusterer.run({at(3, 0), at(3, 0.2f)});
  ASSERT_EQ(result.clusters.size(), 1u);
  EXPECT_EQ(result.clusters[0].box.min(), Eigen::Vector3f(3, 0, 0));
  EXPECT_EQ(result.noise + result.unusable + result.too_large, 0u);
  EXPECT_EQ(result.points.size(), 2u);
}

TEST(Clusterer, AMillionPointsAllFindTheirPlace) {
  Clusterer clusterer(params(0.5, 10, 10000000));
  const Clusters& result = clusterer.run(test::fillBox(1000000, {-50.f, -50.f, -2.f}, {50.f, 50.f, 2.f}));
  EXPECT_EQ(result.points.size() + result.noise, 1000000u);
}

TEST(Clusterer, RefusesParametersOutOfRangeByName) {
  try {
    Clusterer clusterer(params(-3.0, 0));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& fault) {
    EXPECT_NE(std::string(fault.what()).find("epsilon = -3.0"), std::string::npos) << fault.what();
    EXPECT_NE(std::string(fault.what()).find("min_points = 0"), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace field_fusion::core
