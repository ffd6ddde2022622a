#include "field_fusion/core/scan/deskew.h"

#include <gtest/gtest.h>

#include "support/moving_scanner.h"

namespace field_fusion::core {
namespace {

using test::Motion;
using test::Room;
using test::Scanner;

constexpr double kStamp = 2.0;

struct Deskewed {
  Scan raw, binned;
  Cloud points;
  DeskewCounts counts;
};

Deskewed run(
    const Scanner& scanner, const Motion& motion, double instant,
    const std::function<void(Scan&)>& change = [](Scan&) {}) {
  Deskewed out;
  out.raw = scanner.scan({}, motion, kStamp);
  change(out.raw);
  MotionTrack track;
  track.follow(test::historyOf(motion, kStamp - 0.1, kStamp + 0.2), kStamp, scanner.sweep(), instant,
               scanner.T_base_scanner);
  out.counts = ScanDeskewer().run(out.raw, 0.0, out.raw.time_increment, track, out.binned, out.points);
  return out;
}

/// Largest distance of the points from the walls, in the world.
double offTheWalls(const Deskewed& d, const Scanner& scanner, const Motion& motion, double instant) {
  const Transform T_world_scanner = scanner.pose(motion, kStamp + instant);
  double out = 0.0;
  for (const Point& p : d.points)
    out = std::max(out, Room{}.off(T_world_scanner * p.position().cast<double>()));
  return out;
}

const auto kStill = test::steady({0, 0, 0}, {0, 0, 1}, 0.0);
const auto kTurning = test::steady({0, 0, 0}, {0, 0, 1}, radians(90.0));
const auto kWalking = test::steady({1.0, 0.2, 0.1}, {0, 0, 1}, 0.0);

TEST(ScanDeskewer, StandingStillChangesNothing) {
  const auto d = run({}, kStill, 0.0);
  ASSERT_EQ(d.binned.ranges.size(), d.raw.ranges.size());
  for (std::size_t i = 0; i < d.raw.ranges.size(); ++i) {
    EXPECT_NEAR(d.binned.ranges[i], d.raw.ranges[i], 1e-5);
    EXPECT_EQ(d.binned.intensities[i], static_cast<float>(i));
  }
  EXPECT_EQ(d.counts.unseen, 0u);
}

TEST(ScanDeskewer, TurningAt90DegreesASecondLeavesTheWallsStraight) {
  Scanner scanner;
  scanner.T_base_scanner.translation() << 0.2, 0.1, 0.5;
  for (const double instant : {0.0, 0.05, 0.0999}) {
    const auto d = run(scanner, kTurning, instant);
    EXPECT_EQ(d.points.size(), 1600u);
    EXPECT_LT(offTheWalls(d, scanner, kTurning, instant), 1e-4);
  }
  // what it mends: in 0.1 s a wall 5 m away is bent by 9 degrees, 0.79 m
  Deskewed raw = run(scanner, kTurning, 0.0);
  scanPoints(raw.raw, 0.0, raw.raw.time_increment, raw.points);
  EXPECT_GT(offTheWalls(raw, scanner, kTurning, 0.0), 0.3);
}

TEST(ScanDeskewer, WalkingAndTrottingLeaveTheWallsStraight) {
  EXPECT_LT(offTheWalls(run({}, kWalking, 0.0), {}, kWalking, 0.0), 1e-4);
  // between two poses 2 ms apart the gait bends by 1/8 of its acceleration, 5 deg * (4 pi/s)^2: 0.04 mm at 6
  // m
  EXPECT_LT(offTheWalls(run({}, test::trot, 0.05), {}, test::trot, 0.05), 2e-4);
}

TEST(ScanDeskewer, IsTheExactTransformOfEachBeam) {
  Scanner scanner;
  scanner.T_base_scanner.translate(Eigen::Vector3d(0.3, 0, 0.6))
      .rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 1, 1).normalized()));
  const auto history = test::historyOf(test::trot, kStamp - 0.1, kStamp + 0.2);
  const auto d = run(scanner, test::trot, 0.05);
  const Transform T_instant_odom = (history.at(kStamp + 0.05).transform() * scanner.T_base_scanner).inverse();
  ASSERT_EQ(d.points.size(), d.raw.ranges.size());
  for (std::size_t i = 0; i < d.points.size(); ++i) {
    const double time = kStamp + static_cast<double>(i) * d.raw.time_increment;
    const Transform T = T_instant_odom * history.at(time).transform() * scanner.T_base_scanner;
    const Eigen::Vector3d want = T * (d.raw.ranges[i] * Scanner::direction(d.raw.angle(i)));
    EXPECT_LT((d.points[i].position().cast<double>() - want).norm(), 3e-5) << i;
    EXPECT_EQ(d.points[i].time, 0.f);
    EXPECT_EQ(d.points[i].intensity, static_cast<float>(i));
  }
}

TEST(ScanDeskewer, BinsHoldTheNearestOfThePointsInThem) {
  for (const bool clockwise : {false, true}) {
    Scanner scanner;
    scanner.clockwise = clockwise;
    const auto d = run(scanner, test::trot, 0.0);
    std::vector<float> want(d.binned.ranges.size(), kNaN);
    for (const Point& p : d.points) {
      const double place = (std::atan2(p.y, p.x) - d.binned.angle_min) / d.binned.angle_increment;
      const long bins = static_cast<long>(want.size());
      float& nearest = want[static_cast<std::size_t>((std::lround(place) + bins) % bins)];
      nearest = std::fmin(nearest, std::hypot(p.x, p.y));
    }
    int differ = 0;  // a point on the border of two bins
    for (std::size_t i = 0; i < want.size(); ++i)
      differ += !(std::abs(want[i] - d.binned.ranges[i]) < 1e-4f || std::isnan(want[i] + d.binned.ranges[i]));
    EXPECT_LE(differ, 4);
    EXPECT_GT(d.binned.angle_increment, 0.0);
    EXPECT_EQ(d.binned.time_increment, 0.0);
  }
}

TEST(ScanDeskewer, ClockwiseScanStaysOnTheWallsToo) {
  Scanner scanner;
  scanner.clockwise = true;
  EXPECT_LT(offTheWalls(run(scanner, kTurning, 0.0), scanner, kTurning, 0.0), 1e-4);
}

TEST(ScanDeskewer, TurningWithTheBeamLeavesHolesAndAgainstItOverlaps) {
  // 9 degrees in a scan: spread over 369 degrees the beams leave 1 bin in 41 empty, and 9 degrees are seen
  // twice
  EXPECT_NEAR(static_cast<double>(run({}, kTurning, 0.0).counts.unseen), 1600.0 / 41.0, 3.0);
  const auto against = test::steady({0, 0, 0}, {0, 0, 1}, -radians(90.0));
  EXPECT_NEAR(static_cast<double>(run({}, against, 0.0).counts.unseen), 1600.0 * 9.0 / 360.0, 3.0);
}

TEST(ScanDeskewer, ReturnsThatComeNearerThanTheScannerSeesAreNotLost) {
  // walks 1 m/s at a wall straight ahead, 0.15 m away at the end of the scan
  const auto d = run({}, kWalking, 0.0999, [](Scan& scan) {
    std::fill(scan.ranges.begin(), scan.ranges.end(), kNaN);
    scan.ranges[800] = 0.11f;  // measured at 0.05 s, straight ahead; it is 0.06 m away at the end
  });
  ASSERT_EQ(d.points.size(), 1u);
  const float nearest = *std::min_element(d.binned.ranges.begin(), d.binned.ranges.end(),
                                          [](float a, float b) { return b != b || a < b; });
  EXPECT_NEAR(nearest, std::hypot(0.11 - 0.05, 0.01), 2e-3);
  EXPECT_LE(d.binned.range_min, nearest);
}

TEST(ScanDeskewer, FreeNearAndUnknownBeamsKeepTheirMeaning) {
  const auto d = run({}, kStill, 0.0, [](Scan& scan) {
    scan.ranges[10] = kFree;
    scan.ranges[20] = kNear;
    scan.ranges[30] = kNaN;
    scan.ranges[40] = 26.f;  // beyond range_max
  });
  EXPECT_EQ(d.binned.ranges[10], kFree);
  EXPECT_EQ(d.binned.ranges[20], kNear);
  EXPECT_TRUE(std::isnan(d.binned.ranges[30]));
  EXPECT_EQ(d.binned.ranges[40], kFree);
  EXPECT_EQ(d.counts.unseen, 1u);
  EXPECT_EQ(d.counts.returns, 1596u);
  EXPECT_EQ(d.points.size(), 1596u);
}

TEST(ScanDeskewer, FreeBeamsTurnWithTheScanner) {
  const auto d = run({}, kTurning, 0.0, [](Scan& scan) {
    std::fill(scan.ranges.begin(), scan.ranges.end(), kNaN);
    scan.ranges[800] = kFree;  // at 0.05 s: 4.5 degrees further at the start
  });
  EXPECT_EQ(d.binned.ranges[820], kFree);
  EXPECT_EQ(d.counts.unseen, 1599u);
}

TEST(ScanDeskewer, EmptyOneBeamAndChangedGeometry) {
  MotionTrack track;
  track.keepOn({0, 0, 0}, {0, 0, 0}, {0.0, 0.1}, 0.0);
  ScanDeskewer deskewer;
  Scan binned, scan = Scanner{}.scan({}, kStill, 0.0);
  Cloud points(3);
  deskewer.run(scan, 0.0, scan.time_increment, track, binned, points);
  scan.ranges.clear(), scan.intensities.clear();
  EXPECT_EQ(deskewer.run(scan, 0.0, scan.time_increment, track, binned, points).unseen, 1600u);
  EXPECT_TRUE(points.empty());
  EXPECT_TRUE(binned.intensities.empty());
  scan.ranges = {2.f};
  EXPECT_EQ(deskewer.run(scan, 0.0, scan.time_increment, track, binned, points).returns, 1u);
  EXPECT_NEAR(points[0].x, -2.0, 1e-6);
  scan.angle_min = 0.0;
  deskewer.run(scan, 0.0, scan.time_increment, track, binned, points);
  EXPECT_NEAR(points[0].x, 2.0, 1e-6);
}

TEST(ScanPoints, AreTheReturnsAsTheyAreWithTheTimesOfTheirBeams) {
  Scan scan = Scanner{}.scan({}, kStill, 0.0);
  scan.ranges[5] = kFree;
  Cloud points;
  scanPoints(scan, -0.1, scan.time_increment, points);
  ASSERT_EQ(points.size(), 1599u);
  EXPECT_FLOAT_EQ(points[5].time, static_cast<float>(-0.1 + 6 * scan.time_increment));
  EXPECT_NEAR(points[5].position().norm(), scan.ranges[6], 1e-5);
}

}  // namespace
}  // namespace field_fusion::core
