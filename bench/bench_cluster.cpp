// Cost of the clustering beside pcl::EuclideanClusterExtraction on a street scene, of each method, and how it
// grows.
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <cmath>

#include "../test/support/brute_dbscan.h"
#include "../test/support/street.h"
#include "field_fusion/core/cloud/cluster.h"
#include "figure.h"

namespace {

using namespace field_fusion;
using bench::Figure;

constexpr int kRepeats = 41;

core::ClusterParams benchParams() {
  core::ClusterParams params;
  params.method = core::ClusterMethod::kDbscan;
  params.epsilon = 0.5;
  params.min_points = 10;
  params.max_points = 10000000;
  params.oriented_boxes = false;  // PCL fits none either
  return params;
}

bool equalsBruteForce(const core::Cloud& cloud) {
  core::Clusterer clusterer(benchParams());
  const auto ours = test::inOrderOfAppearance(clusterer.run(cloud).labels);
  const bool equal = ours == test::bruteDbscan(cloud, 0.5f, 10);
  std::printf(
      "labels of %zu points %s a brute-force DBSCAN (a border point joins its nearest core point,\n"
      "the earlier of two equally near; noise: no core point within epsilon)\n",
      cloud.size(), equal ? "equal" : "DIFFER FROM");
  return equal;
}

/// As a node would: a fresh tree and a fresh extractor for each cloud, the conversion not counted.
std::size_t pclClusters(const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud) {
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(0.5);
  extraction.setMinClusterSize(10);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters.size();
}

void compareWithPcl(const core::Cloud& cloud) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr same(new pcl::PointCloud<pcl::PointXYZ>);
  for (const core::Point& p : cloud) same->push_back({p.x, p.y, p.z});
  core::Clusterer clusterer(benchParams());
  std::size_t theirs = 0;
  const auto cost = bench::duel(
      kRepeats, [&] { theirs = pclClusters(same); }, [&] { clusterer.run(cloud); });
  std::printf(
      "%zu points: PCL Euclidean (tolerance 0.5, min 10) %.2f ms, %zu clusters; DBSCAN (epsilon 0.5, min 10) "
      "%.2f ms, %zu clusters\n",
      cloud.size(), bench::median(cost.a), theirs, bench::median(cost.b),
      clusterer.run(cloud).clusters.size());
  bench::print("cluster/dbscan/ratio", bench::medianFigure(cost.ratios()), "-");
  bench::print("cluster/dbscan/cost", bench::medianFigure(cost.b), "ms");
}

/// The other methods, and what the oriented boxes add.
void methods(const core::Cloud& cloud) {
  using core::ClusterMethod;
  core::ClusterParams params = benchParams();
  core::Clusterer clusterer;
  const auto measure = [&](const char* name, ClusterMethod method) {
    params.method = method;
    clusterer.setParams(params);
    const auto cost = bench::costs(kRepeats, [&] { clusterer.run(cloud); });
    std::printf("%zu clusters of %s\n", clusterer.run(cloud).clusters.size(), name);
    bench::print(std::string("cluster/") + name + "/cost", bench::medianFigure(cost), "ms");
  };
  measure("adaptive", ClusterMethod::kAdaptive);
  measure("dbscan_beta", ClusterMethod::kDbscanBeta);
  measure("range_image", ClusterMethod::kRangeImage);
  measure("euclidean", ClusterMethod::kEuclidean);
  params.oriented_boxes = true;
  measure("dbscan_with_oriented_boxes", ClusterMethod::kDbscan);
}

/// The same street seen with ever more rays.
void growth() {
  test::StreetScan dense;
  dense.rings = 128;
  dense.columns = 2700;
  core::Cloud cloud = test::scanStreet(dense).off_ground;
  std::mt19937 random(1);
  std::shuffle(cloud.begin(), cloud.end(), random);  // so that any first n points cover the whole street
  core::Clusterer clusterer(benchParams());
  std::vector<double> log_n, log_ms;
  for (const int thousands : {5, 10, 20, 50, 100, 200}) {
    const std::size_t n = 1000u * thousands;
    if (cloud.size() < n)
      throw std::runtime_error("the street has fewer than " + std::to_string(n) + " points");
    const core::Cloud part(cloud.begin(), cloud.begin() + static_cast<std::ptrdiff_t>(n));
    const Figure cost = bench::medianFigure(bench::costs(kRepeats, [&] { clusterer.run(part); }));
    bench::print("cluster/dbscan/cost_" + std::to_string(thousands) + "k", cost, "ms");
    log_n.push_back(std::log(n)), log_ms.push_back(std::log(cost.value));
  }
  const Eigen::Map<const Eigen::ArrayXd> x(log_n.data(), log_n.size()), y(log_ms.data(), log_ms.size());
  const double slope = ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
  std::printf("cost grows as n^%.2f from 5k to 200k points\n", slope);
}

}  // namespace

int main() {
  const core::Cloud cloud = test::scanStreet().off_ground;
  if (!equalsBruteForce(cloud)) return 1;
  compareWithPcl(cloud);
  methods(cloud);
  growth();
  return 0;
}
