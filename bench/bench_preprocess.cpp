// Cost of what stands between a raw cloud and its clusters: filter, ground and DBSCAN on one core.
#include <cstdio>

#include "../test/support/street.h"
#include "field_fusion/core/cloud/cluster.h"
#include "field_fusion/core/cloud/filter.h"
#include "field_fusion/core/cloud/ground.h"
#include "figure.h"

namespace {

using namespace field_fusion;

constexpr int kRepeats = 101;

core::FilterParams filterParams() {
  core::FilterParams params;
  params.min_range = 0.5;
  params.max_range = 100.0;
  params.box = {-100.0, -30.0, -3.0, 100.0, 30.0, 10.0};
  params.body = {-1.0, -0.5, -1.8, 1.0, 0.5, 0.2};
  return params;
}

core::Cloud street(std::size_t points) {
  test::StreetScan scan;
  scan.columns = 2100;
  core::Cloud cloud = test::scanStreet(scan).all;
  if (cloud.size() < points)
    throw std::runtime_error("the street has fewer than " + std::to_string(points) + " points");
  cloud.resize(points);
  return cloud;
}

}  // namespace

int main() {
  const core::Cloud cloud = street(28800);
  core::Filter filter(filterParams());
  core::GroundFinder finder;
  core::Clusterer clusterer;
  core::Cloud kept, floor, obstacles;
  core::Ground ground;
  std::vector<double> filter_ms, ground_ms, cluster_ms, sum_ms;
  for (int i = 0; i < kRepeats; ++i) {
    filter_ms.push_back(bench::costMs([&] { filter.run(cloud, kept); }));
    ground_ms.push_back(bench::costMs([&] { ground = finder.run(kept, 0.1 * i, floor, obstacles); }));
    cluster_ms.push_back(bench::costMs([&] { clusterer.run(obstacles); }));
    sum_ms.push_back(filter_ms.back() + ground_ms.back() + cluster_ms.back());
  }
  if (!ground.found()) {
    std::printf("no ground: %s\n", describe(ground.fault));
    return 1;
  }
  std::printf("%zu points: %zu kept, %zu ground (sensor %.2f m up, truth 1.80), %zu clusters\n", cloud.size(),
              kept.size(), ground.inliers, ground.plane.offset, clusterer.run(obstacles).clusters.size());
  bench::print("preprocess/filter", bench::medianFigure(filter_ms), "ms");
  bench::print("preprocess/ground", bench::medianFigure(ground_ms), "ms");
  bench::print("preprocess/cluster", bench::medianFigure(cluster_ms), "ms");
  bench::print("preprocess/cost", bench::medianFigure(sum_ms), "ms");
  return 0;
}
