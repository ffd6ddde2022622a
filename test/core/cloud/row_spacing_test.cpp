#include "field_fusion/core/cloud/row_spacing.h"

#include <gtest/gtest.h>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

Point ray(double elevation_deg, double range, std::uint16_t ring, double azimuth = 0.3) {
  const Eigen::Vector3f p = cartesian({range, azimuth, radians(elevation_deg)}).cast<float>();
  Point out = at(p.x(), p.y(), p.z());
  out.ring = ring;
  return out;
}

/// Rows two degrees apart, the lowest at -15 deg, each with points at several ranges.
Cloud sixteenRows() {
  Cloud out;
  for (std::uint16_t ring = 0; ring < 16; ++ring)
    for (const double range : {3.0, 40.0, 17.0}) out.push_back(ray(2.0 * ring - 15.0, range, ring));
  return out;
}

TEST(RowSpacing, MeasuresTheAngleBetweenRows) {
  EXPECT_NEAR(degrees(RowSpacing().measure(sixteenRows())), 2.0, 1e-4);
}

TEST(RowSpacing, IsTheMedianSoThatMissingAndUnevenRowsHaveNoSay) {
  Cloud cloud;
  for (const int ring : {0, 1, 2, 3, 5, 6, 40}) cloud.push_back(ray(0.5 * ring, 10.0, ring));
  cloud.push_back(ray(25.0, 10.0, 41));
  EXPECT_NEAR(degrees(RowSpacing().measure(cloud)), 0.5, 1e-4);
}

TEST(RowSpacing, IsZeroWithoutNeighbouringRings) {
  RowSpacing spacing;
  EXPECT_EQ(spacing.measure({}), 0.0);
  EXPECT_EQ(spacing.measure({ray(1, 5, 3), ray(1, 7, 3), ray(9, 5, 7)}), 0.0);
  EXPECT_EQ(spacing.measure({ray(1, 5, kUnknownRing), ray(3, 5, kUnknownRing - 1)}), 0.0);
}

TEST(RowSpacing, UnusablePointsHaveNoSay) {
  Cloud cloud = sixteenRows();
  for (const Point& bad : {at(kNaN, 1), at(1, INFINITY), at(0, 0, 4), at(0, 0, 0)}) {
    cloud.push_back(bad);
    cloud.back().ring = 7;
  }
  EXPECT_NEAR(degrees(RowSpacing().measure(cloud)), 2.0, 1e-4);
}

TEST(RowSpacing, NeighbouringRowsLieWithinEpsilonAtAnyRange) {
  const double gap = radians(2.0);
  for (const double range : {5.0, 20.0, 70.0}) {
    Cloud pole, out;
    for (std::uint16_t ring = 0; ring < 16; ++ring) pole.push_back(ray(2.0 * ring - 15.0, range, ring));
    RowSpacing::close(pole, gap, 0.5, out);
    for (std::size_t i = 1; i < out.size(); ++i) EXPECT_LT(out[i].z - out[i - 1].z, 0.5f) << range;
  }
}

TEST(RowSpacing, ChangesNothingButTheHeightOfFarPoints) {
  const double gap = radians(2.0), start = 0.5 / (1.2 * gap);
  const Cloud cloud{ray(10, 0.99 * start, 4), ray(10, 2.0 * start, 5)};
  Cloud out;
  RowSpacing::close(cloud, gap, 0.5, out);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].z, cloud[0].z);
  EXPECT_NEAR(out[1].z, 0.5f * cloud[1].z, 1e-5f);
  EXPECT_EQ(out[1].x, cloud[1].x);
  EXPECT_EQ(out[1].ring, 5);
  RowSpacing::close(cloud, 0.0, 0.5, out);
  EXPECT_EQ(out[1].z, cloud[1].z);
}

}  // namespace
}  // namespace field_fusion::core
