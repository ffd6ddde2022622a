#include "field_fusion/core/match/round_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace field_fusion::core {
namespace {

using Eigen::Vector2d;

Point at(const Vector2d& p) {
  Point out;
  out.x = static_cast<float>(p.x()), out.y = static_cast<float>(p.y());
  return out;
}

/// What a scanner of `step` [deg] sees of a circle: its near side, or its far side through it, with the noise
/// of `sigma` [m]; each beam with the probability `share`.
void scan(const Vector2d& centre, double radius, bool far, double share, double sigma, std::mt19937& random,
          std::vector<Point>& out, double step = 0.2) {
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  const double first = std::atan2(centre.y(), centre.x());
  for (int i = -400; i <= 400; ++i) {
    const double azimuth = first + radians(step) * i;
    const double along = centre.norm() * std::cos(azimuth - first);
    const double aside = centre.norm() * std::sin(azimuth - first);
    if (std::abs(aside) >= radius || std::abs(azimuth - first) > radians(80) || chance(random) > share)
      continue;
    const double half = std::sqrt(radius * radius - aside * aside);
    const double range = (far ? along + half : along - half) + sigma * noise(random);
    out.push_back(at(range * Vector2d(std::cos(azimuth), std::sin(azimuth))));
  }
}

double spreadOf(const RoundFit& fit) {
  return std::sqrt(fit.covariance.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
}

// the near side is measured, so that the middle is off by no more than the radius is unknown
TEST(RoundFit, OfANearSideTheRadiusIsTheClasss) {
  std::mt19937 random(1);
  for (const double truth : {0.36, 0.4, 0.44})
    for (const double range : {3.0, 8.0, 20.0}) {
      const Vector2d centre(0.9 * range, -0.43589 * range);
      std::vector<Point> points;
      for (int row = 0; row < 3; ++row) scan(centre, truth, false, 1.0, 0.01, random, points);
      const RoundFit fit = RoundFitter().fit(points, {0.4, 0.0, 0.1, 0.03});
      SCOPED_TRACE(testing::Message() << truth << " m at " << range << " m");
      EXPECT_NEAR(fit.centre.norm() - fit.radius, centre.norm() - truth, 0.03);
      EXPECT_LT((fit.centre - centre).norm(), 0.06);
      EXPECT_NEAR(fit.radius, 0.4, 0.05);
      EXPECT_NEAR(std::atan2(fit.centre.y(), fit.centre.x()), std::atan2(centre.y(), centre.x()),
                  radians(0.1));
      EXPECT_GT(spreadOf(fit), 0.01);
      EXPECT_LT(spreadOf(fit), 0.2);
    }
}

// the net alone: its near and its far side tell the middle, whatever the true radius is
TEST(RoundFit, OfANetBothSidesTellTheMiddle) {
  std::mt19937 random(2);
  for (const double size : {0.9, 1.0, 1.1})
    for (const double range : {4.0, 10.0}) {
      const Vector2d centre(range, 0.3);
      std::vector<Point> points;
      for (int row = 0; row < 4; ++row) {
        scan(centre, 0.66 * size, false, 0.3, 0.015, random, points);
        scan(centre, 0.66 * size, true, 0.2, 0.015, random, points);
      }
      const RoundFit fit = RoundFitter().fit(points, {1.0, 0.66, 0.1, 0.03});
      SCOPED_TRACE(testing::Message() << size << " m at " << range << " m");
      EXPECT_LT((fit.centre - centre).norm(), 0.05);
      EXPECT_NEAR(fit.radius, size, 0.05);
    }
}

TEST(RoundFit, WhereTheFloatsAreSeenTheyAreTheOutline) {
  std::mt19937 random(3);
  const Vector2d centre(5, 1);
  std::vector<Point> points;
  scan(centre, 1.05, false, 1.0, 0.01, random, points);
  for (int row = 0; row < 3; ++row) {
    scan(centre, 0.69, false, 0.3, 0.015, random, points);
    scan(centre, 0.69, true, 0.2, 0.015, random, points);
  }
  const RoundFit fit = RoundFitter().fit(points, {1.0, 0.66, 0.1, 0.03});
  EXPECT_LT((fit.centre - centre).norm(), 0.03);
  EXPECT_NEAR(fit.radius, 1.05, 0.02);
}

TEST(RoundFit, OnePointIsTheNearestOfTheBody) {
  const RoundFit fit = RoundFitter().fit({at({3, 4})}, {0.5, 0.0, 0.1, 0.03});
  EXPECT_TRUE(fit.centre.isApprox(1.1 * Vector2d(3, 4), 0.02)) << fit.centre.transpose();
  EXPECT_NEAR(fit.radius, 0.5, 0.05);
  EXPECT_GE(spreadOf(fit), 0.03);
}

TEST(RoundFit, AcrossTheSeamOfAzimuthsNothingChanges) {
  std::mt19937 random(4);
  const Vector2d centre(-6, 0.05);
  std::vector<Point> points;
  scan(centre, 0.4, false, 1.0, 0.01, random, points);
  EXPECT_LT((RoundFitter().fit(points, {0.4, 0.0, 0.1, 0.03}).centre - centre).norm(), 0.05);
}

TEST(RoundFit, ManyPointsAreThinnedInTheOrderGiven) {
  std::mt19937 random(5);
  const Vector2d centre(7, 2);
  std::vector<Point> points;
  for (int row = 0; row < 50; ++row) scan(centre, 0.8, false, 1.0, 0.01, random, points, 0.1);
  ASSERT_GT(points.size(), 3000u);
  EXPECT_LT((RoundFitter().fit(points, {0.8, 0.0, 0.1, 0.03}).centre - centre).norm(), 0.08);
}

TEST(RoundFit, StrayPointsHaveLittleSay) {
  std::mt19937 random(6);
  const Vector2d centre(10, 0);
  std::vector<Point> points;
  for (int row = 0; row < 4; ++row) scan(centre, 1.0, false, 1.0, 0.01, random, points);
  points.push_back(at({7, 0.2}));
  points.push_back(at({14, -0.5}));
  const RoundFit fit = RoundFitter().fit(points, {1.0, 0.0, 0.1, 0.03});
  EXPECT_LT((fit.centre - centre).norm(), 0.12);
  EXPECT_NEAR(fit.centre.norm() - fit.radius, 9.0, 0.03);
}

TEST(RoundFit, WhatHasNoPlaceHasNoMiddle) {
  const RoundPrior prior{0.5, 0.0, 0.1, 0.03};
  EXPECT_TRUE(RoundFitter().fit({}, prior).centre.array().isNaN().all());
  EXPECT_TRUE(RoundFitter().fit({at({0, 0})}, prior).centre.array().isNaN().all());
  EXPECT_TRUE(RoundFitter().fit({at({5, 0}), at({kNaN, 0})}, prior).centre.array().isNaN().all());
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(RoundFitter().fit({at({far, 1})}, prior).centre.array().isNaN().all());
}

TEST(RoundFit, TheSameAgainAfterAnother) {
  std::mt19937 random(7);
  std::vector<Point> points, others;
  scan({4, 1}, 0.5, false, 1.0, 0.01, random, points);
  scan({9, -3}, 2.0, false, 0.5, 0.02, random, others);
  const RoundPrior prior{0.5, 0.0, 0.1, 0.03};
  RoundFitter fitter;
  const RoundFit first = fitter.fit(points, prior);
  fitter.fit(others, {2.0, 1.5, 0.1, 0.03});
  EXPECT_EQ(fitter.fit(points, prior).centre, first.centre);
}

}  // namespace
}  // namespace field_fusion::core
