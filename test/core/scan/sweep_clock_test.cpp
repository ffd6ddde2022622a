#include "field_fusion/core/scan/sweep_clock.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

using Basis = SweepTiming::Basis;

/// 360 beams of 1 degree.
Scan scanOf(double time_increment, double scan_time) {
  Scan out;
  out.angle_increment = radians(1.0);
  out.time_increment = time_increment;
  out.scan_time = scan_time;
  out.range_max = 10.0;
  out.ranges.assign(360, 1.f);
  return out;
}

/// The last of 20 scans that come `spacing` [s] apart.
SweepTiming after20(const Scan& scan, double spacing, double sweep_time = 0.0) {
  SweepClock clock;
  SweepTiming out;
  for (int i = 0; i < 20; ++i) out = clock.of(scan, 100.0 + spacing * i, sweep_time);
  return out;
}

TEST(SweepClock, BelievesAMessageThatAgreesWithItself) {
  const auto timing = after20(scanOf(0.1 / 360, 0.1), 0.1);
  EXPECT_EQ(timing.basis, Basis::kMessage);
  EXPECT_DOUBLE_EQ(timing.time_increment, 0.1 / 360);
  EXPECT_FALSE(timing.scan_time_is_wrong);
  EXPECT_EQ(timing.scan_time, 0.1);
}

TEST(SweepClock, ZeroIsOneInstant) {
  const auto timing = after20(scanOf(0.0, 0.0), 0.1);
  EXPECT_EQ(timing.basis, Basis::kInstant);
  EXPECT_EQ(timing.time_increment, 0.0);
}

TEST(SweepClock, UserKnowsBetter) {
  for (const double sent : {0.0, 1.0, 1e-6}) {
    const auto timing = after20(scanOf(sent, 0.1), 0.1, 0.2);
    EXPECT_EQ(timing.basis, Basis::kParameter);
    EXPECT_DOUBLE_EQ(timing.time_increment, 0.2 / 360);
  }
}

TEST(SweepClock, ScanThatLastsLongerThanScansAreApartIsWrong) {
  const auto timing = after20(scanOf(1.0 / 360, 0.1), 0.1);
  EXPECT_EQ(timing.basis, Basis::kSpacing);
  EXPECT_NEAR(timing.time_increment, 0.1 / 360, 1e-9);
}

TEST(SweepClock, FirstScansAreBelievedUntilTheSpacingIsKnown) {
  SweepClock clock;
  EXPECT_EQ(clock.of(scanOf(1.0 / 360, 0.0), 1.0, 0.0).basis, Basis::kMessage);
}

TEST(SweepClock, JitterAndLostScansDoNotMislead) {
  SweepClock clock;
  double stamp = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double jitter = i % 2 ? 0.01 : -0.01;
    stamp += i % 5 == 4 ? 0.2 : 0.1;
    EXPECT_EQ(clock.of(scanOf(0.1 / 360, 0.1), stamp + jitter, 0.0).basis, Basis::kMessage) << i;
  }
}

TEST(SweepClock, WrongScanTimeIsReplacedByTheSpacing) {
  for (const double sent : {0.5, 0.01}) {  // longer than scans are apart; shorter than its beams take
    const auto timing = after20(scanOf(0.1 / 360, sent), 0.1);
    EXPECT_TRUE(timing.scan_time_is_wrong) << sent;
    EXPECT_NEAR(timing.scan_time, 0.1, 1e-9);
    EXPECT_EQ(timing.basis, Basis::kMessage);
  }
  EXPECT_FALSE(after20(scanOf(0.1 / 360, 0.1), 0.2).scan_time_is_wrong) << "every other scan is left out";
  EXPECT_FALSE(after20(scanOf(0.1 / 360, 0.0), 0.1).scan_time_is_wrong) << "0: not known";
}

TEST(SweepClock, ResetForgetsTheSpacing) {
  SweepClock clock;
  for (int i = 0; i < 20; ++i) clock.of(scanOf(0.0, 0.0), 100.0 + 0.1 * i, 0.0);
  clock.reset();
  EXPECT_EQ(clock.of(scanOf(1.0 / 360, 0.0), 1.0, 0.0).basis, Basis::kMessage);
}

TEST(SweepClock, EmptyScanAndOneBeamAreNoFault) {
  Scan scan = scanOf(0.1, 0.1);
  scan.ranges.clear();
  EXPECT_EQ(after20(scan, 0.1).basis, Basis::kMessage);
  scan.ranges.assign(1, 1.f);
  EXPECT_EQ(after20(scan, 0.1).basis, Basis::kMessage);
}

}  // namespace
}  // namespace field_fusion::core
