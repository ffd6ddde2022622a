#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "field_fusion/core/base/latency.h"
#include "field_fusion/core/base/stamp_order.h"

namespace field_fusion::core {
namespace {

using Verdict = StampOrder::Verdict;
constexpr std::int64_t kSecond = 1'000'000'000;

TEST(StampOrder, OneSecondBackIsOutOfOrderAndMoreIsAJump) {
  StampOrder order;
  EXPECT_EQ(order.check(10 * kSecond), Verdict::kNewer);
  EXPECT_EQ(order.check(9 * kSecond), Verdict::kOutOfOrder);  // exactly at the limit
  EXPECT_EQ(order.check(9 * kSecond - 1), Verdict::kTimeJump);
  EXPECT_EQ(order.check(9 * kSecond), Verdict::kNewer) << "after a jump the new time counts";
}

TEST(StampOrder, EqualStampIsOutOfOrder) {
  StampOrder order;
  EXPECT_EQ(order.check(5), Verdict::kNewer);
  EXPECT_EQ(order.check(5), Verdict::kOutOfOrder);
}

TEST(StampOrder, LateStampsDoNotPullTheClockBack) {
  // stamps 10.0 9.5 9.0 8.5: the last lies 1.5 s behind the newest, so it is a jump
  StampOrder order;
  order.check(10 * kSecond);
  EXPECT_EQ(order.check(9 * kSecond + kSecond / 2), Verdict::kOutOfOrder);
  EXPECT_EQ(order.check(8 * kSecond + kSecond / 2), Verdict::kTimeJump);
}

TEST(StampOrder, ShortBagThatLoopsIsAJumpAfterARunOfRisingLateStamps) {
  // a bag of 0.9 s, twice: 10.0 ... 10.9, 10.0 ...
  StampOrder order;
  const auto frame = [](int i) { return 10 * kSecond + i * kSecond / 10; };
  for (int i = 0; i < 10; ++i) EXPECT_EQ(order.check(frame(i)), Verdict::kNewer);
  for (int i = 0; i < StampOrder::kJumpRun - 1; ++i) EXPECT_EQ(order.check(frame(i)), Verdict::kOutOfOrder);
  EXPECT_EQ(order.check(frame(StampOrder::kJumpRun - 1)), Verdict::kTimeJump);
  EXPECT_EQ(order.check(frame(StampOrder::kJumpRun)), Verdict::kNewer);
}

TEST(StampOrder, SecondSourceThatLagsIsNoJump) {
  // two sources on one topic, one 0.3 s behind: between its stamps come newer ones
  StampOrder order;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(order.check((10 + i) * kSecond), Verdict::kNewer);
    EXPECT_EQ(order.check((10 + i) * kSecond - kSecond * 3 / 10), Verdict::kOutOfOrder);
  }
}

TEST(StampOrder, OneStampForEverIsNoJump) {
  StampOrder order;
  EXPECT_EQ(order.check(7), Verdict::kNewer);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order.check(7), Verdict::kOutOfOrder);
}

TEST(RevisionOrder, RevisionsAreSeriesOfTheirOwn) {
  RevisionOrder order;
  EXPECT_EQ(order.check(1 * kSecond, 0), Verdict::kNewer);
  EXPECT_EQ(order.check(2 * kSecond, 0), Verdict::kNewer);
  EXPECT_EQ(order.check(1 * kSecond, 1), Verdict::kNewer) << "the second of the first comes after";
  EXPECT_EQ(order.check(1 * kSecond, 1), Verdict::kOutOfOrder);
  EXPECT_EQ(order.check(2 * kSecond, 1), Verdict::kNewer);
}

TEST(RevisionOrder, JumpOfOneSeriesIsOneJump) {
  RevisionOrder order;
  order.check(100 * kSecond, 0);
  order.check(100 * kSecond, 1);
  EXPECT_EQ(order.check(5 * kSecond, 0), Verdict::kTimeJump);
  EXPECT_EQ(order.check(5 * kSecond, 1), Verdict::kNewer);
  EXPECT_EQ(order.check(6 * kSecond, 0), Verdict::kNewer);
}

TEST(ClockAhead, AStampFarAheadIsNotBelievedUnlessTheOneBeforeWasAsFar) {
  ClockAhead clock;
  constexpr std::int64_t kNow = 1000 * kSecond, kTenth = kSecond / 10;
  EXPECT_EQ(clock.check(kNow, kNow), 0.0);
  EXPECT_EQ(clock.check(kNow + kSecond, kNow), 0.0) << "exactly at the limit";
  EXPECT_NEAR(clock.check(kNow + 3600 * kSecond, kNow), 3600.0, 1e-6);
  EXPECT_EQ(clock.check(kNow + kTenth, kNow), 0.0) << "it was one alone";
  EXPECT_NEAR(clock.check(kNow + 37 * kSecond, kNow), 37.0, 1e-6);
  for (int i = 1; i < 50; ++i)
    EXPECT_EQ(clock.check(kNow + 37 * kSecond + i * kTenth, kNow + i * kTenth), 0.0) << "a sender whose clock is ahead";
}

TEST(ClockAhead, TheFirstStampIsNoneTheBetterForBeingTheFirst) {
  ClockAhead clock;
  EXPECT_GT(clock.check(100 * kSecond, 50 * kSecond), 0.0);
  EXPECT_EQ(clock.check(50 * kSecond, 50 * kSecond), 0.0);
}

TEST(ClockAhead, WhatIsOldOrWithoutAClockIsBelieved) {
  ClockAhead clock;
  EXPECT_EQ(clock.check(5 * kSecond, 0), 0.0) << "simulated time that has not begun";
  EXPECT_EQ(clock.check(5 * kSecond, 1000 * kSecond), 0.0) << "a recording";
  EXPECT_EQ(clock.check(900 * kSecond, 1000 * kSecond), 0.0);
}

TEST(Latency, EmptyKnowsNothing) {
  const Latency latency;
  EXPECT_TRUE(std::isnan(latency.percentile(0.5)));
  EXPECT_TRUE(std::isnan(latency.max()));
}

TEST(Latency, PercentilesLieWithinOneBinOfTheExactOnes) {
  Latency latency;
  for (int i = 1; i <= 1000; ++i) latency.add(i * 1e-3);  // 1 ms ... 1 s: p-th percentile is p seconds
  for (const double p : {0.01, 0.5, 0.95, 0.99}) {
    EXPECT_GE(latency.percentile(p), p * (1.0 - 1e-9));
    EXPECT_LE(latency.percentile(p), p * 1.05);
  }
  EXPECT_EQ(latency.percentile(1.0), 1.0);
  EXPECT_EQ(latency.max(), 1.0);
}

TEST(Latency, ExtremesAreCountedNotLost) {
  Latency latency;
  latency.add(-1.0);
  latency.add(std::nan(""));
  latency.add(std::numeric_limits<double>::infinity());
  latency.add(1e9);
  EXPECT_EQ(latency.count(), 4u);
  EXPECT_EQ(latency.max(), 1e9);
  EXPECT_LE(latency.percentile(0.5), 1e-6);
}

}  // namespace
}  // namespace field_fusion::core
