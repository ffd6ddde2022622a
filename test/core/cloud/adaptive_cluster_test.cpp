// What sets the method `adaptive` apart: it keeps step with the scanner's resolution.
#include <gtest/gtest.h>

#include "field_fusion/core/cloud/cluster.h"
#include "support/clouds.h"

namespace field_fusion::core {
namespace {

std::size_t clusters(const Cloud& cloud, const ClusterParams& params = {}) {
  Clusterer clusterer(params);
  return clusterer.run(cloud).clusters.size();
}

/// `count` points 5 cm apart across the line of sight, the nearest at (range, 0, 0).
Cloud row(int count, float range) {
  Cloud out;
  for (int i = 0; i < count; ++i) out.push_back(test::at(range, 0.05f * i));
  return out;
}

TEST(AdaptiveCluster, NeedsFewerPointsTheFartherAwayBut4) {
  ClusterParams params;
  params.min_points = 12, params.full_range = 20.0;
  EXPECT_EQ(clusters(row(11, 19.9f), params), 0u);
  EXPECT_EQ(clusters(row(12, 19.9f), params), 1u);
  EXPECT_EQ(clusters(row(11, 28.2f), params), 1u);  // 12 * (20 / 28.2)^2 = 6.04
  EXPECT_EQ(clusters(row(6, 28.2f), params), 0u);
  EXPECT_EQ(clusters(row(7, 28.2f), params), 1u);
  EXPECT_EQ(clusters(row(3, 90.f), params), 0u);
  EXPECT_EQ(clusters(row(4, 90.f), params), 1u);
}

/// A pole seen at `range` by rows 2 deg apart, five points a row.
Cloud pole(double range) {
  Cloud out;
  for (std::uint16_t ring = 0; ring < 4; ++ring)
    for (int i = 0; i < 5; ++i) {
      const Eigen::Vector3f p = cartesian({range, radians(0.1 * i), radians(2.0 * ring)}).cast<float>();
      out.push_back(test::at(p.x(), p.y(), p.z()));
      out.back().ring = ring;
    }
  return out;
}

TEST(AdaptiveCluster, RowsOfAFarBodyHangTogether) {
  EXPECT_EQ(clusters(pole(50.0)), 1u);
  ClusterParams density;
  density.method = ClusterMethod::kDbscan, density.min_points = 4;
  EXPECT_EQ(clusters(pole(50.0), density), 4u);
}

TEST(AdaptiveCluster, WithoutRingsTheParameterSaysHowFarRowsAreApart) {
  Cloud cloud = pole(50.0);
  for (Point& p : cloud) p.ring = kUnknownRing;
  EXPECT_EQ(clusters(cloud), 4u);
  ClusterParams params;
  Clusterer clusterer(params);
  EXPECT_EQ(clusterer.run(cloud).row_gap, 0.0) << "not known: the stage warns";
  params.row_gap = 2.0;
  EXPECT_EQ(clusters(cloud, params), 1u);
}

TEST(AdaptiveCluster, TheBoxHoldsTheTrueHeights) {
  Clusterer clusterer;
  const Clusters& found = clusterer.run(pole(50.0));
  ASSERT_EQ(found.clusters.size(), 1u);
  EXPECT_NEAR(found.clusters[0].box.max().z(), 50.0 * std::sin(radians(6.0)), 1e-4);
}

}  // namespace
}  // namespace field_fusion::core
