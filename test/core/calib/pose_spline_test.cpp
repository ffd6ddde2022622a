#include "field_fusion/core/calib/pose_spline.h"

#include <gtest/gtest.h>

#include <numeric>

namespace field_fusion::core {
namespace {

double sum(const std::array<double, kSplineOrder>& w) { return std::accumulate(w.begin(), w.end(), 0.0); }

TEST(PoseSpline, WeightsSumToOneAndTheirDerivativesToNothing) {
  for (const double u : {0.0, 0.1, 0.5, 0.999, 1.0}) {
    EXPECT_NEAR(sum(splineWeights(u, 0)), 1.0, 1e-14);
    EXPECT_NEAR(sum(splineWeights(u, 1)), 0.0, 1e-14);
    EXPECT_NEAR(sum(splineWeights(u, 2)), 0.0, 1e-13);
    for (const double w : splineWeights(u, 0)) EXPECT_GE(w, 0.0);
  }
}

TEST(PoseSpline, AParabolaComesBackWiderByTheVarianceOfTheWeights) {
  // of six boxes of width 1: 6 / 12
  const SplineGrid grid = SplineGrid::over(2.0, 5.0, 0.25);
  for (const double time : {2.0, 2.1, 3.33, 4.999, 5.0}) {
    const int segment = grid.segment(time);
    const double u = (time - grid.start(segment)) / grid.step;
    double value[3] = {};
    for (int derivative = 0; derivative < 3; ++derivative) {
      const auto w = splineWeights(u, derivative);
      for (int j = 0; j < kSplineOrder; ++j)
        value[derivative] += w[static_cast<std::size_t>(j)] * std::pow(grid.centre(segment + j), 2) /
                             std::pow(grid.step, derivative);
    }
    EXPECT_NEAR(value[0], time * time + 0.5 * grid.step * grid.step, 1e-12);
    EXPECT_NEAR(value[1], 2.0 * time, 1e-10);
    EXPECT_NEAR(value[2], 2.0, 1e-9);
  }
}

TEST(PoseSpline, SegmentsJoinWithTheirFirstTwoDerivatives) {
  for (int derivative = 0; derivative < 3; ++derivative) {
    const auto end = splineWeights(1.0, derivative), begin = splineWeights(0.0, derivative);
    EXPECT_NEAR(end[0], 0.0, 1e-14);
    for (std::size_t j = 1; j < kSplineOrder; ++j) EXPECT_NEAR(end[j], begin[j - 1], 1e-14);
  }
}

TEST(PoseSpline, AGridCoversItsTimeAlsoWhereItIsShorterThanAStep) {
  const SplineGrid grid = SplineGrid::over(1.0, 2.05, 0.1);
  EXPECT_EQ(grid.segments, 11);
  EXPECT_DOUBLE_EQ(grid.start(grid.segments), 2.05);
  EXPECT_EQ(grid.points(), 16);
  EXPECT_EQ(grid.segment(0.0), 0);
  EXPECT_EQ(grid.segment(1.0), 0);
  EXPECT_EQ(grid.segment(2.05), 10);
  EXPECT_EQ(grid.segment(9.0), 10);
  EXPECT_EQ(SplineGrid::over(1.0, 1.01, 0.1).segments, 1);
}

TEST(PoseSpline, ARotationVectorTurnsAsAngleAndAxisDo) {
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-4, 0.3, 3.1, 5.0}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((rotationOf<double>(angle * axis) - expected).norm(), 1e-12) << angle;
  }
}

TEST(PoseSpline, TheRateIsThatOfTheTurnedFrame) {
  const Eigen::Vector3d change(0.4, -0.7, 1.1);
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e-5, 0, 2e-5), Eigen::Vector3d(0.5, 1.0, -2.0)}) {
    constexpr double kHalf = 1e-5;
    const Eigen::AngleAxisd step(Eigen::Matrix3d(rotationOf<double>(turn - kHalf * change).transpose() *
                                                 rotationOf<double>(turn + kHalf * change)));
    EXPECT_LT((bodyRate<double>(turn, change) - step.axis() * step.angle() / (2 * kHalf)).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace field_fusion::core
