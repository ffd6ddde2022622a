#include "field_fusion/core/match/tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace field_fusion::core {
namespace {

const ToleranceParams kParams{1.0, 5.0};

Polar seen(double range, double azimuth_degrees) { return {range, radians(azimuth_degrees), 0.0}; }

Verdicts match(const std::vector<Polar>& lidar, const std::vector<Polar>& camera) {
  return ToleranceMatcher(kParams).run(lidar, camera);
}

TEST(ToleranceMatcher, EmptySidesGiveEmptyVerdicts) {
  const Verdicts v = match({}, {});
  EXPECT_TRUE(v.lidar.empty());
  EXPECT_TRUE(v.camera.empty());
}

TEST(ToleranceMatcher, OneSideAloneHasNoCandidate) {
  EXPECT_EQ(match({seen(5, 0)}, {}).lidar[0].reason, MatchReason::kNoCandidate);
  const Verdict camera = match({}, {seen(5, 0)}).camera[0];
  EXPECT_EQ(camera.reason, MatchReason::kNoCandidate);
  EXPECT_EQ(camera.partner, -1);
  EXPECT_TRUE(std::isnan(camera.range_difference));
}

TEST(ToleranceMatcher, PairKeepsBothSignedDifferences) {
  const Verdicts v = match({seen(5.5, 10)}, {seen(5.0, 12)});
  for (const Verdict& side : {v.lidar[0], v.camera[0]}) {
    EXPECT_EQ(side.reason, MatchReason::kMatched);
    EXPECT_EQ(side.partner, 0);
    EXPECT_DOUBLE_EQ(side.range_difference, 0.5);
    EXPECT_NEAR(side.azimuth_difference, radians(-2), 1e-12);
  }
}

TEST(ToleranceMatcher, LimitsAreInside) {
  EXPECT_EQ(match({seen(6, 0)}, {seen(5, 5)}).lidar[0].reason, MatchReason::kMatched);
  EXPECT_EQ(match({seen(5, 0)}, {seen(6, -5)}).lidar[0].reason, MatchReason::kMatched);
}

TEST(ToleranceMatcher, BeyondALimitNamesTheOneThatFails) {
  EXPECT_EQ(match({seen(6.001, 0)}, {seen(5, 0)}).lidar[0].reason, MatchReason::kRangeDiffers);
  EXPECT_EQ(match({seen(5, 5.001)}, {seen(5, 0)}).camera[0].reason, MatchReason::kAzimuthDiffers);
}

TEST(ToleranceMatcher, BothFailingNamesTheWorse) {
  EXPECT_EQ(match({seen(8, 6)}, {seen(5, 0)}).lidar[0].reason, MatchReason::kRangeDiffers);
  EXPECT_EQ(match({seen(6.5, 40)}, {seen(5, 0)}).lidar[0].reason, MatchReason::kAzimuthDiffers);
}

TEST(ToleranceMatcher, AzimuthIsComparedAcrossTheBack) {
  const Verdicts v = match({seen(5, 179)}, {seen(5, -179)});
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kMatched);
  EXPECT_NEAR(v.lidar[0].azimuth_difference, radians(-2), 1e-12);
}

TEST(ToleranceMatcher, ClosestPairWinsAndTheOtherIsTaken) {
  const Verdicts v = match({seen(5.6, 0), seen(5.1, 0)}, {seen(5, 0)});
  EXPECT_EQ(v.lidar[1].partner, 0);
  EXPECT_EQ(v.camera[0].partner, 1);
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kTaken);
  EXPECT_NEAR(v.lidar[0].range_difference, 0.6, 1e-12);
}

// the nearest by sum (1.1 of the range tolerance) is outside, the one inside went to a better partner
TEST(ToleranceMatcher, TakenCountsBeforeACloserCandidateOutside) {
  const Verdicts v = match({seen(5, 0), seen(5.8, -4.8)}, {seen(6.1, 0), seen(5.8, -4.7)});
  EXPECT_EQ(v.lidar[1].partner, 1);
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kTaken);
}

TEST(ToleranceMatcher, DetectionWithoutRangeStaysAlone) {
  const Verdicts v = match({seen(5, 0), seen(7, 20)}, {seen(kNaN, 1)});
  EXPECT_EQ(v.camera[0].reason, MatchReason::kRangeUnknown);
  EXPECT_TRUE(std::isnan(v.camera[0].range_difference));
  EXPECT_NEAR(v.camera[0].azimuth_difference, radians(-1), 1e-12);
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kRangeUnknown);
  EXPECT_EQ(v.lidar[1].reason, MatchReason::kAzimuthDiffers);
  EXPECT_EQ(match({}, {seen(kNaN, 1)}).camera[0].reason, MatchReason::kRangeUnknown);
}

TEST(ToleranceMatcher, DetectionWithoutBearingStaysAlone) {
  const Verdicts v = match({seen(5, 0)}, {seen(5, kNaN)});
  EXPECT_EQ(v.camera[0].reason, MatchReason::kNoBearing);
  EXPECT_EQ(v.lidar[0].reason, MatchReason::kNoBearing);
  EXPECT_TRUE(std::isnan(v.lidar[0].azimuth_difference));
}

TEST(ToleranceMatcher, InfiniteNumbersNeverMatch) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(match({seen(inf, 0)}, {seen(inf, 0)}).camera[0].reason, MatchReason::kRangeUnknown);
  EXPECT_EQ(match({seen(5, 0)}, {{5, inf, 0}}).camera[0].reason, MatchReason::kNoBearing);
}

TEST(ToleranceMatcher, EqualTargetsPairByPlace) {
  const std::vector<Polar> same(4, seen(5, 0));
  const Verdicts v = match(same, same);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(v.lidar[i].partner, i);
}

/// A target's own values, which stay with it however the list is shuffled.
using Partners = std::vector<std::pair<double, double>>;
Partners partnersByValue(const std::vector<Polar>& lidar, const std::vector<Polar>& camera) {
  const Verdicts v = match(lidar, camera);
  Partners out;
  for (std::size_t i = 0; i < lidar.size(); ++i)
    out.emplace_back(lidar[i].range, v.lidar[i].partner < 0 ? -1.0 : camera[v.lidar[i].partner].range);
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Polar> scatter(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> range(3, 12), azimuth(-20, 20);
  std::vector<Polar> out;
  for (int i = 0; i < n; ++i) out.push_back(seen(range(random), azimuth(random)));
  return out;
}

TEST(ToleranceMatcher, OrderOfTargetsHasNoSay) {
  std::mt19937 random(3);
  auto lidar = scatter(30, random), camera = scatter(30, random);
  lidar.push_back(seen(5, 2)), lidar.push_back(seen(5.5, 2)),
      camera.push_back(seen(5.25, 2));  // an exact tie
  const auto expected = partnersByValue(lidar, camera);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(lidar.begin(), lidar.end(), random);
    std::shuffle(camera.begin(), camera.end(), random);
    EXPECT_EQ(partnersByValue(lidar, camera), expected);
  }
}

/// The stated rule, word for word: again and again the pair with the least sum among those still free.
std::vector<int> slowMatch(const std::vector<Polar>& lidar, const std::vector<Polar>& camera) {
  std::vector<int> partner(lidar.size(), -1);
  std::vector<bool> taken(camera.size(), false);
  for (;;) {
    double least = 3.0;  // within the tolerances no sum is above 2
    int best_l = -1, best_c = -1;
    for (std::size_t l = 0; l < lidar.size(); ++l)
      for (std::size_t c = 0; c < camera.size(); ++c) {
        if (partner[l] >= 0 || taken[c]) continue;
        const double dd = std::abs(lidar[l].range - camera[c].range) / kParams.dist_tolerance;
        const double da = std::abs(lidar[l].azimuth - camera[c].azimuth) / radians(kParams.angle_tolerance);
        if (dd > 1 || da > 1 || dd * dd + da * da >= least) continue;
        least = dd * dd + da * da, best_l = static_cast<int>(l), best_c = static_cast<int>(c);
      }
    if (best_l < 0) return partner;
    partner[best_l] = best_c;
    taken[best_c] = true;
  }
}

TEST(ToleranceMatcher, AgreesWithTheRuleOnRandomTargets) {
  std::mt19937 random(7);
  int matched = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto lidar = scatter(40, random), camera = scatter(25, random);
    const auto expected = slowMatch(lidar, camera);
    const Verdicts v = match(lidar, camera);
    for (std::size_t i = 0; i < lidar.size(); ++i) {
      EXPECT_EQ(v.lidar[i].partner, expected[i]);
      if (expected[i] < 0) continue;
      ++matched;
      EXPECT_EQ(v.camera[expected[i]].partner, static_cast<int>(i));
    }
  }
  EXPECT_GT(matched, 500);
}

}  // namespace
}  // namespace field_fusion::core
