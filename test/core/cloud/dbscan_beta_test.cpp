#include "field_fusion/core/cloud/dbscan_beta.h"

#include <gtest/gtest.h>

#include <random>

#include "support/brute_dbscan.h"
#include "support/clouds.h"
#include "support/street.h"

namespace field_fusion::core {
namespace {

using test::at;
using test::inOrderOfAppearance;
using Labels = std::vector<int>;

const double kTheta = radians(10.0);

Labels labelled(const Cloud& cloud, float epsilon, int min_points, double theta = kTheta) {
  return inOrderOfAppearance(DbscanBeta().run(cloud, epsilon, min_points, theta));
}

/// Paper 001 Eq. 7 as it is written, alpha being the angle between the two rays.
double equation7(const Point& p, const Point& q) {
  Eigen::Vector3d a = p.position().cast<double>(), b = q.position().cast<double>();
  if (b.norm() > a.norm()) std::swap(a, b);
  const double alpha = std::atan2(a.cross(b).norm(), a.dot(b));
  return std::atan2(b.norm() * std::sin(alpha), a.norm() - b.norm() * std::cos(alpha));
}

Labels brute(const Cloud& cloud, float epsilon, int min_points, double theta = kTheta) {
  return test::bruteDbscan(cloud, min_points, [&](const Point& a, const Point& b) {
    const bool equal = a.position() == b.position();
    return test::distance2(a, b) <= epsilon * epsilon && (equal || equation7(a, b) > theta);
  });
}

double beta(const Point& a, const Point& b) { return depthStep(a.position(), b.position()).beta(); }

TEST(DepthStep, BetaIsEquation7InEitherOrder) {
  const Cloud cloud = test::fillBox(200, {-9.f, -9.f, -3.f}, {9.f, 9.f, 3.f});
  for (std::size_t i = 1; i < cloud.size(); ++i) {
    EXPECT_NEAR(beta(cloud[i - 1], cloud[i]), equation7(cloud[i - 1], cloud[i]), 1e-9);
    EXPECT_EQ(beta(cloud[i - 1], cloud[i]), beta(cloud[i], cloud[i - 1]));
  }
}

TEST(DepthStep, BetaOfPlainTrianglesIsAsDrawn) {
  EXPECT_NEAR(beta(at(10, 0), at(9, 1)), radians(45.0), 1e-12);  // foot at x = 9: |AC| = |BC| = 1
  EXPECT_NEAR(beta(at(10, 0), at(0, 10)), radians(45.0), 1e-12);
  EXPECT_NEAR(beta(at(0, 0, 5), at(0, 0, -5)), 0.0, 1e-12);
}

TEST(DepthStep, BetaIsNoughtOnOneRayAndARightAngleForEqualPoints) {
  EXPECT_EQ(beta(at(4, 2), at(2, 1)), 0.0);
  EXPECT_EQ(beta(at(4, 2), at(0, 0)), 0.0);
  EXPECT_EQ(beta(at(4, 2, 1), at(4, 2, 1)), radians(90.0));
  EXPECT_EQ(beta(at(0, 0), at(0, 0)), radians(90.0));
}

TEST(DepthStep, SidesAreInMetres) {
  const DepthStep step = depthStep({10.f, 0.f, 0.f}, {7.f, 2.f, 0.f});
  EXPECT_TRUE(step.alongWithin(3.0001));
  EXPECT_FALSE(step.alongWithin(2.9999));
  EXPECT_TRUE(step.acrossWithin(2.0001));
  EXPECT_FALSE(step.acrossWithin(1.9999));
}

TEST(DbscanBeta, DoesNotReachAlongARay) {
  EXPECT_EQ(labelled(test::line(5, 0.1f, 3.f), 0.5f, 2), Labels(5, kNoise));
  EXPECT_EQ(labelled({at(3, 0), at(3, 0.1f), at(3, 0.2f)}, 0.5f, 2), Labels(3, 0));
}

TEST(DbscanBeta, JoinsPointsAtTheOriginOnlyWithTheirEquals) {
  EXPECT_EQ(labelled({at(0, 0), at(0.1f, 0), at(0, 0)}, 0.5f, 2), (Labels{0, kNoise, 0}));
}

TEST(DbscanBeta, ANeighbourAtExactlyThetaDoesNotCount) {
  const Cloud cloud{at(10, 0), at(9, 1)};  // beta = 45 deg
  EXPECT_EQ(labelled(cloud, 2.f, 2, radians(45.001)), Labels(2, kNoise));
  EXPECT_EQ(labelled(cloud, 2.f, 2, radians(44.999)), Labels(2, 0));
}

TEST(DbscanBeta, EqualPointsAreOneClusterHoweverMany) {
  EXPECT_EQ(labelled(Cloud(100000, at(3, -4, 5)), 0.5f, 1000), Labels(100000, 0));
}

TEST(DbscanBeta, RefusesParametersWithoutMeaning) {
  EXPECT_THROW(labelled({}, 0.f, 10), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5f, 0), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5f, 10, radians(90.0)), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5f, 10, kNaN), std::invalid_argument);
}

struct Case {
  float epsilon;
  int min_points;
  double theta;  ///< [deg]
  float size;    ///< [m] of the box round the sensor that 600 points are drawn from
};

class DbscanBetaOnRandomClouds : public testing::TestWithParam<Case> {};

TEST_P(DbscanBetaOnRandomClouds, EqualsBruteForce) {
  const auto [epsilon, min_points, theta, size] = GetParam();
  DbscanBeta dbscan;  // one for all, so that nothing may stay behind from the cloud before
  for (unsigned seed = 0; seed < 6; ++seed) {
    Cloud cloud = test::fillBox(600, {-size, -size, -0.3f * size}, {size, size, 0.3f * size}, seed);
    cloud.insert(cloud.end(), cloud.begin(), cloud.begin() + 50);
    cloud.insert(cloud.begin() + 9, {at(0, 0), at(kNaN, 0), at(0, 0)});
    ASSERT_EQ(inOrderOfAppearance(dbscan.run(cloud, epsilon, min_points, radians(theta))),
              brute(cloud, epsilon, min_points, radians(theta)))
        << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(SparseToDense, DbscanBetaOnRandomClouds,
                         testing::Values(Case{0.5f, 10, 10.0, 3.f}, Case{0.5f, 4, 40.0, 3.f},
                                         Case{0.5f, 2, 60.0, 3.f}, Case{1.f, 20, 30.0, 3.f},
                                         Case{2.f, 1, 85.0, 3.f}, Case{0.3f, 3, 0.0, 2.f}));

TEST(DbscanBeta, EqualsBruteForceOnAStreet) {
  test::StreetScan scan;
  scan.columns = 300;
  const Cloud cloud = test::scanStreet(scan).off_ground;
  ASSERT_GT(cloud.size(), 2000u);
  EXPECT_EQ(labelled(cloud, 0.8f, 5), brute(cloud, 0.8f, 5));
}

}  // namespace
}  // namespace field_fusion::core
