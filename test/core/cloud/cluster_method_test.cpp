// What holds for every method of clustering, and that `euclidean` is PCL's.
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <random>

#include "field_fusion/core/cloud/cluster.h"
#include "support/brute_dbscan.h"
#include "support/clouds.h"
#include "support/street.h"

namespace field_fusion::core {
namespace {

using test::at;
using Labels = std::vector<int>;

ClusterParams params(ClusterMethod method, int min_points, double epsilon = 0.5, int max_points = 20000) {
  ClusterParams out;
  out.method = method, out.min_points = min_points, out.epsilon = epsilon, out.max_points = max_points;
  return out;
}

class EveryMethod : public testing::TestWithParam<ClusterMethod> {
 protected:
  const Clusters& run(const Cloud& cloud, int min_points, int max_points = 20000) {
    clusterer_.setParams(params(GetParam(), min_points, 0.5, max_points));
    return clusterer_.run(cloud);
  }

 private:
  Clusterer clusterer_;
};

TEST_P(EveryMethod, FindsNothingInAnEmptyCloud) {
  const Clusters& result = run({}, 1);
  EXPECT_TRUE(result.clusters.empty() && result.labels.empty() && result.points.empty());
  EXPECT_EQ(result.noise + result.unusable + result.too_large, 0u);
}

TEST_P(EveryMethod, OnePointIsAClusterOnlyWhenOneIsEnough) {
  EXPECT_EQ(run({at(1, 2, 3)}, 1).labels, Labels{0});
  EXPECT_EQ(run({at(1, 2, 3)}, 2).labels, Labels{kNoise});
  EXPECT_EQ(run({at(1, 2, 3)}, 2).noise, 1u);
}

TEST_P(EveryMethod, UnusablePointsAreCountedAndInNoCluster) {
  const Clusters& result = run({at(kNaN, 0), at(3, 0), at(0, -INFINITY), at(3, 0.1f), at(0, 2e7f)}, 2);
  EXPECT_EQ(result.labels, (Labels{kNoise, 0, kNoise, 0, kNoise}));
  EXPECT_EQ(result.unusable, 3u);
  EXPECT_EQ(result.noise, 0u);
}

TEST_P(EveryMethod, EqualPointsAreOneCluster) {
  EXPECT_EQ(run(Cloud(5000, at(3, -4, 5)), 100).labels, Labels(5000, 0));
}

TEST_P(EveryMethod, BodiesFarApartAreClustersOfTheirOwn) {
  const Cloud cloud{at(5, 0), at(5, 0.1f), at(5, 0.2f), at(0, 9), at(0.1f, 9), at(0.2f, 9), at(-30, 0)};
  const Clusters& result = run(cloud, 3);
  EXPECT_EQ(result.labels, (Labels{0, 0, 0, 1, 1, 1, kNoise}));
  EXPECT_EQ(result.noise, 1u);
}

TEST_P(EveryMethod, LeavesOutAndCountsWhatIsTooLarge) {
  const Clusters& result = run({at(5, 0), at(5, 0.1f), at(5, 0.2f), at(0, 9), at(0.1f, 9)}, 2, 2);
  EXPECT_EQ(result.labels, (Labels{kNoise, kNoise, kNoise, 0, 0}));
  EXPECT_EQ(result.too_large, 1u);
  EXPECT_EQ(result.noise, 0u);
}

TEST_P(EveryMethod, OrderOfThePointsDoesNotMatter) {
  test::StreetScan scan;
  scan.columns = 600;
  const Cloud cloud = test::scanStreet(scan).off_ground;
  const Labels before = run(cloud, 5).labels;
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Cloud shuffled;
  for (const std::size_t i : order) shuffled.push_back(cloud[i]);
  const Labels& after = run(shuffled, 5).labels;
  Labels back(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) back[order[i]] = after[i];
  EXPECT_EQ(back, before);
  EXPECT_GT(*std::max_element(before.begin(), before.end()), 20);
}

INSTANTIATE_TEST_SUITE_P(All, EveryMethod,
                         testing::Values(ClusterMethod::kAdaptive, ClusterMethod::kDbscan,
                                         ClusterMethod::kDbscanBeta, ClusterMethod::kRangeImage,
                                         ClusterMethod::kEuclidean),
                         [](const auto& info) {
                           ClusterParams named = params(info.param, 1);
                           return std::get<std::string>(declarationOf(named).find("method")->get());
                         });

/// The labels of PCL's clusters, in order of appearance.
Labels pclLabels(const Cloud& cloud, double tolerance, int fewest, int most) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr same(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Point& p : cloud) same->push_back({p.x, p.y, p.z});
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(tolerance);
  extraction.setMinClusterSize(fewest);
  extraction.setMaxClusterSize(most);
  extraction.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  extraction.setInputCloud(same);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  Labels out(cloud.size(), kNoise);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    for (const int i : clusters[k].indices) out[i] = static_cast<int>(k);
  return test::inOrderOfAppearance(out);
}

Labels euclidean(const Cloud& cloud, double tolerance, int fewest, int most) {
  Clusterer clusterer(params(ClusterMethod::kEuclidean, fewest, tolerance, most));
  return test::inOrderOfAppearance(clusterer.run(cloud).labels);
}

TEST(Euclidean, EqualsPclOnRandomCloudsAndAStreet) {
  for (const int fewest : {1, 4, 20})
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Cloud cloud = test::fillBox(1500, {-4.f, -4.f, -1.f}, {4.f, 4.f, 1.f}, seed);
      ASSERT_EQ(euclidean(cloud, 0.3, fewest, 100), pclLabels(cloud, 0.3, fewest, 100)) << "seed " << seed;
    }
  const Cloud street = test::scanStreet().off_ground;
  EXPECT_EQ(euclidean(street, 0.5, 10, 1000), pclLabels(street, 0.5, 10, 1000));
}

TEST(Euclidean, PointsAtExactlyTheToleranceAreApartAsInPcl) {
  Cloud cloud = test::line(4, 0.5f);
  EXPECT_EQ(euclidean(cloud, 0.5, 1, 100), (Labels{0, 1, 2, 3}));
  EXPECT_EQ(pclLabels(cloud, 0.5, 1, 100), (Labels{0, 1, 2, 3}));
  cloud[1].x = 0.4999f;
  EXPECT_EQ(euclidean(cloud, 0.5, 1, 100), (Labels{0, 0, 1, 2}));
  EXPECT_EQ(pclLabels(cloud, 0.5, 1, 100), (Labels{0, 0, 1, 2}));
}

}  // namespace
}  // namespace field_fusion::core
