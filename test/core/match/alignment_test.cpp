#include "field_fusion/core/match/alignment.h"

#include <gtest/gtest.h>

#include <random>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

constexpr double kStep = 0.1;  // [s]

/// Pairs at 10 Hz; the differences of each second share an error drawn with `deviation` [deg].
struct Pairs {
  AlignmentWatch watch;
  std::mt19937 draw{3};
  double stamp = 1000.0;

  void pass(int seconds, double azimuth, double elevation, double deviation) {
    std::normal_distribution<double> error(0.0, deviation);
    for (int s = 0; s < seconds; ++s) {
      const Eigen::Array2d mean(radians(azimuth + error(draw)), radians(elevation + error(draw)));
      for (int i = 0; i < 10; ++i, stamp += kStep) watch.add(stamp + 1e-6, mean);
    }
  }
  bool fault(double floor = 0.3) {
    const auto drift = watch.drift();
    EXPECT_TRUE(drift);
    return drift && AlignmentWatch::isFault(*drift, {floor});
  }
};

TEST(AlignmentWatch, KnowsNothingBeforeThereAreEnoughSeconds) {
  Pairs pairs;
  EXPECT_FALSE(pairs.watch.drift());
  pairs.pass(90, 0, 0, 0);
  EXPECT_FALSE(pairs.watch.drift());  // the ninetieth second may go on
  pairs.pass(1, 0, 0, 0);
  ASSERT_TRUE(pairs.watch.drift());
}

TEST(AlignmentWatch, MeansAreThoseOfTheFirstMinuteAndOfTheLastHalf) {
  Pairs pairs;
  pairs.pass(60, 0.5, -0.2, 0);
  pairs.pass(100, 1.5, -0.3, 0);
  const auto drift = pairs.watch.drift();
  ASSERT_TRUE(drift);
  EXPECT_NEAR(degrees(drift->usual.x()), 0.5, 1e-9);
  EXPECT_NEAR(degrees(drift->usual.y()), -0.2, 1e-9);
  EXPECT_NEAR(degrees(drift->now.x()), 1.5, 1e-9);
  EXPECT_NEAR(degrees(drift->now.y()), -0.3, 1e-9);
}

TEST(AlignmentWatch, AMovedCameraIsAFaultInEitherAngle) {
  for (const double azimuth : {0.0, 1.0, -1.0})
    for (const double elevation : {0.0, 1.0}) {
      Pairs pairs;
      pairs.pass(60, 0.5, 0.1, 0.1);
      pairs.pass(31, 0.5 + azimuth, 0.1 + elevation, 0.1);
      EXPECT_EQ(pairs.fault(), azimuth != 0.0 || elevation != 0.0) << azimuth << " " << elevation;
    }
}

TEST(AlignmentWatch, WhatVariesMuchFromTheStartMayGoOnToVary) {
  Pairs pairs;
  pairs.pass(60, 0, 0, 0.5);
  pairs.pass(31, 1.0, 0, 0.0);  // two deviations
  EXPECT_FALSE(pairs.fault());
  pairs.pass(31, 2.0, 0, 0.0);  // four
  EXPECT_TRUE(pairs.fault());
}

TEST(AlignmentWatch, AShiftBelowTheFloorIsNoFault) {
  Pairs pairs;
  pairs.pass(60, 0, 0, 0);
  pairs.pass(31, 0.2, 0, 0);
  EXPECT_FALSE(pairs.fault(0.3));
  EXPECT_TRUE(pairs.fault(0.1));
}

TEST(AlignmentWatch, WhatIsNotKnownIsLeftOut) {
  Pairs pairs;
  pairs.pass(91, 0, 0, 0);
  for (int i = 0; i < 1000; ++i, pairs.stamp += kStep) pairs.watch.add(pairs.stamp, {1.0, kNaN});
  EXPECT_EQ(pairs.watch.drift()->now.x(), 0.0);
}

}  // namespace
}  // namespace field_fusion::core
