// Points that are too few for a cluster, told of for a camera to decide.
#include <gtest/gtest.h>

#include <limits>

#include "field_fusion/core/cloud/cluster.h"
#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

ClusterParams params(ClusterMethod method = ClusterMethod::kDbscan) {
  ClusterParams out;
  out.method = method;
  out.epsilon = 0.5, out.min_points = 5, out.full_range = 1000.0, out.row_gap = 0.01;
  out.faint = true;
  return out;
}

/// Five points in a row at 3 m, two at 9 m, one at 6 m.
const Cloud kScene{at(9, 0),      at(3, 0),      at(3, 0.1f), at(6, 5), at(3, 0.2f),
                   at(3, 0.3f), at(9, 0.3f), at(3, 0.4f)};

class FaintCluster : public testing::TestWithParam<ClusterMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, FaintCluster,
                         testing::Values(ClusterMethod::kAdaptive, ClusterMethod::kDbscan,
                                         ClusterMethod::kDbscanBeta, ClusterMethod::kEuclidean));

TEST_P(FaintCluster, ComesAfterTheOthersByRange) {
  Clusterer clusterer(params(GetParam()));
  const Clusters& result = clusterer.run(kScene);
  ASSERT_EQ(result.clusters.size(), 3u);
  EXPECT_EQ(result.faint, 2u);
  EXPECT_FALSE(result.clusters[0].faint);
  EXPECT_EQ(result.clusters[0].points.count, 5u);
  EXPECT_TRUE(result.clusters[1].faint && result.clusters[2].faint);
  EXPECT_EQ(result.clusters[1].centre, Eigen::Vector3f(6, 5, 0));
  EXPECT_FLOAT_EQ(result.clusters[1].nearest_range, std::sqrt(61.f));
  EXPECT_EQ(result.clusters[2].points.count, 2u);
  const Point* pair = result.points.data() + result.clusters[2].points.first;
  EXPECT_EQ(pair[0].position(), Eigen::Vector3f(9, 0, 0));
  EXPECT_EQ(pair[1].position(), Eigen::Vector3f(9, 0.3f, 0));
  EXPECT_EQ(result.noise, 3u) << "still noise: nobody has said that they are bodies";
  EXPECT_EQ(result.labels, (std::vector<int>{-1, 0, 0, -1, 0, 0, -1, 0}));
}

TEST_P(FaintCluster, IsNotToldOfUnlessAskedFor) {
  ClusterParams silent = params(GetParam());
  silent.faint = false;
  Clusterer clusterer(silent);
  EXPECT_EQ(clusterer.run(kScene).clusters.size(), 1u);
  EXPECT_EQ(clusterer.run(kScene).faint, 0u);
}

TEST(FaintClusters, NothingOfNothingAndOnePointOfOne) {
  Clusterer clusterer(params());
  EXPECT_TRUE(clusterer.run({}).clusters.empty());
  const Clusters& one = clusterer.run({at(2, 1)});
  ASSERT_EQ(one.clusters.size(), 1u);
  EXPECT_TRUE(one.clusters[0].faint);
  EXPECT_EQ(one.clusters[0].box.sizes(), Eigen::Vector3f::Zero());
}

TEST(FaintClusters, PointsThatAreNotFiniteAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Clusterer clusterer(params());
  EXPECT_TRUE(clusterer.run({at(nan, 0), at(0, inf), at(-inf, nan)}).clusters.empty());
}

TEST(FaintClusters, WhatIsTooLargeIsNotFaint) {
  ClusterParams small = params();
  small.max_points = 4;
  Clusterer clusterer(small);
  const Clusters& result = clusterer.run(kScene);
  EXPECT_EQ(result.too_large, 1u);
  EXPECT_EQ(result.clusters.size(), 2u);
}

TEST(FaintClusters, OrderOfThePointsHasNoSay) {
  Clusterer clusterer(params());
  const std::vector<Cluster> before = clusterer.run(kScene).clusters;
  const std::vector<Cluster>& after = clusterer.run(Cloud(kScene.rbegin(), kScene.rend())).clusters;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t c = 0; c < before.size(); ++c) EXPECT_EQ(after[c].centre, before[c].centre);
}

}  // namespace
}  // namespace field_fusion::core
