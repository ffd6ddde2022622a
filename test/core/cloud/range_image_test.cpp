#include "field_fusion/core/cloud/range_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "field_fusion/core/cloud/dbscan.h"
#include "support/brute_dbscan.h"
#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;
using Labels = std::vector<int>;

Labels labelled(const Cloud& cloud, double epsilon = 0.5, double theta = radians(10.0)) {
  return test::inOrderOfAppearance(RangeImage().run(cloud, epsilon, theta));
}

Point ray(double range, double azimuth_deg, double elevation_deg, int ring) {
  const Eigen::Vector3d p = cartesian({range, radians(azimuth_deg), radians(elevation_deg)});
  Point out = at(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  out.ring = static_cast<std::uint16_t>(ring);
  return out;
}

/// A scanner of 16 rows `row_step` [deg] apart and columns `column_step` [deg] apart looks at upright faces
/// across x: `seen` gives the distance x [m] at y and z, or NaN.
using Faces = std::function<double(double y_over_x, double z_over_x)>;
Cloud look(const Faces& seen, double row_step = 2.0, double column_step = 0.2) {
  Cloud out;
  for (double azimuth = -20.0; azimuth <= 20.0; azimuth += column_step)
    for (int ring = 0; ring < 16; ++ring) {
      const double elevation = row_step * (ring - 7.5);
      const Eigen::Vector3d unit = cartesian({1.0, radians(azimuth), radians(elevation)});
      const double x = seen(unit.y() / unit.x(), unit.z() / unit.x());
      if (x > 0.0) out.push_back(ray(x / unit.x(), azimuth, elevation, ring));
    }
  return out;
}

/// `x` where the ray through (1, y, z) meets a face there of a width and heights, else `behind`.
double face(double x, double y, double z, double half_width, double low, double high, double behind) {
  return std::abs(y * x) <= half_width && z * x >= low && z * x <= high ? x : behind;
}

Cloud withoutRings(Cloud cloud) {
  for (Point& p : cloud) p.ring = kUnknownRing;
  return cloud;
}

int clusterCount(const Labels& labels) { return *std::max_element(labels.begin(), labels.end()) + 1; }

struct Layout {
  double row_step, column_step;  ///< [deg]
  bool rings;
};

class RangeImageOfALayout : public testing::TestWithParam<Layout> {
 protected:
  Cloud look(const Faces& seen) const {
    const auto [row_step, column_step, rings] = GetParam();
    const Cloud cloud = core::look(seen, row_step, column_step);
    return rings ? cloud : withoutRings(cloud);
  }
};

TEST_P(RangeImageOfALayout, LeavesABodyWhole) {
  for (const double x : {5.0, 15.0, 30.0}) {
    const Cloud cloud = look([x](double y, double z) { return face(x, y, z, 0.9, -1.5, 1.5, kNaN); });
    ASSERT_GT(cloud.size(), 10u);
    EXPECT_EQ(labelled(cloud), Labels(cloud.size(), 0)) << x << " m";
  }
}

TEST_P(RangeImageOfALayout, KeepsACarOffTheWallBehindIt) {
  const Cloud cloud = look([](double y, double z) { return face(15.0, y, z, 0.9, -1.5, 0.5, 17.0); });
  const Labels labels = labelled(cloud);
  EXPECT_EQ(clusterCount(labels), 2);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_EQ(labels[i] == labels[0], cloud[i].x > 16.f) << i;  // the first ray meets the wall
}

TEST_P(RangeImageOfALayout, PartsTwoBodiesSideBySide) {
  const Cloud cloud = look([](double y, double z) {
    return std::abs(y * 10.0) < 0.4 ? kNaN : face(10.0, y, z, 1.5, -1.0, 1.0, kNaN);
  });
  const Labels labels = labelled(cloud);
  EXPECT_EQ(clusterCount(labels), 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(labels[i] == labels[0], cloud[i].y < 0.f);
}

INSTANTIATE_TEST_SUITE_P(RowsAndColumns, RangeImageOfALayout,
                         testing::Values(Layout{2.0, 0.2, true}, Layout{2.0, 0.2, false},
                                         Layout{1.33, 0.4, true}, Layout{1.33, 0.4, false},
                                         Layout{0.5, 0.1, true}, Layout{0.5, 0.1, false}));

// Rows 2 deg apart are 0.52 m apart at 15 m: DBSCAN slices what the range image leaves whole.
TEST(RangeImage, JoinsRowsThatAreFartherApartThanEpsilon) {
  const Cloud cloud = look([](double y, double z) { return face(15.0, y, z, 0.9, -1.5, 1.5, kNaN); });
  EXPECT_EQ(labelled(cloud), Labels(cloud.size(), 0));
  EXPECT_GT(clusterCount(Dbscan().run(cloud, 0.5f, 5)), 1);
}

TEST(RangeImage, JoinsAWallOnBothSidesOfAPole) {
  const Cloud cloud = look([](double y, double z) { return face(6.0, y, z, 0.08, -9.0, 9.0, 10.0); });
  const Labels labels = labelled(cloud);
  EXPECT_EQ(clusterCount(labels), 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(labels[i] == 0, cloud[i].x > 8.f);
}

TEST(RangeImage, JoinsAcrossARowThatSawNothing) {
  Cloud cloud = look([](double y, double z) { return face(8.0, y, z, 0.9, -1.0, 1.0, kNaN); });
  cloud.erase(std::remove_if(cloud.begin(), cloud.end(), [](const Point& p) { return p.ring == 7; }),
              cloud.end());
  EXPECT_EQ(labelled(cloud), Labels(cloud.size(), 0));
  EXPECT_EQ(labelled(withoutRings(cloud)), Labels(cloud.size(), 0));
}

TEST(RangeImage, JoinsAcrossTheSeamBehindTheSensor) {
  EXPECT_EQ(labelled({ray(9, 179.9, 0, 3), ray(9, -179.9, 0, 3)}), Labels(2, 0));
  EXPECT_EQ(labelled({ray(9, 179.9, 0, 3), ray(9, -179.9, 2, 4)}), Labels(2, 0));
}

TEST(RangeImage, RowsTooFarApartAreNotJoined) {
  EXPECT_EQ(labelled({ray(9, 0, 0, 3), ray(9, 0, 4.9, 4)}), Labels(2, 0));
  EXPECT_EQ(labelled({ray(9, 0, 0, 3), ray(9, 0, 5.1, 4)}), (Labels{0, 1}));
  EXPECT_EQ(labelled({ray(9, 0, 0, 3), ray(9, 0, 2, 6)}), (Labels{0, 1}));
}

TEST(RangeImage, StepsInDepthPart) {
  EXPECT_EQ(labelled({ray(10, 0, 0, 3), ray(10.1, 0.2, 0, 3)}), Labels(2, 0));    // beta = 19 deg
  EXPECT_EQ(labelled({ray(10, 0, 0, 3), ray(10.3, 0.2, 0, 3)}), (Labels{0, 1}));  // beta = 7 deg
  EXPECT_EQ(labelled({ray(10, 0, 0, 3), ray(10.6, 0, 2, 4)}), (Labels{0, 1}));    // beta = 30 deg
  EXPECT_EQ(labelled({ray(10, 0, 0, 3), ray(10.6, 0, 2, 4)}, 0.7), Labels(2, 0));
}

TEST(RangeImage, PointAtTheOriginAndUnusablePointsAreNoise) {
  RangeImage image;
  const Cloud cloud{at(0, 0), at(3, 0), at(kNaN, 1), at(3, 0), at(0, INFINITY)};
  EXPECT_EQ(image.run(cloud, 0.5, 0.1), (Labels{kNoise, 0, kNoise, 0, kNoise}));
  EXPECT_EQ(image.usableCount(), 3u);
  EXPECT_EQ(image.clusterCount(), 1);
}

TEST(RangeImage, RefusesParametersWithoutMeaning) {
  EXPECT_THROW(labelled({}, 0.0), std::invalid_argument);
  EXPECT_THROW(labelled({}, kNaN), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5, radians(90.0)), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5, -0.1), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
