#include "field_fusion/core/scan/scan.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

Scan scanOf(std::size_t beams, double first_deg, double step_deg) {
  Scan out;
  out.angle_min = radians(first_deg);
  out.angle_increment = radians(step_deg);
  out.range_min = 0.2, out.range_max = 10.0;
  out.ranges.assign(beams, 1.f);
  return out;
}

std::size_t binAt(const ScanBins& bins, double azimuth_deg) {
  return bins.at(static_cast<float>(std::cos(radians(azimuth_deg))),
                 static_cast<float>(std::sin(radians(azimuth_deg))));
}

TEST(ScanBins, OfAFullTurnAreTheBeamsThemselves) {
  const Scan scan = scanOf(1600, -180.0, 0.225);
  const ScanBins bins = ScanBins::about(scan);
  ASSERT_EQ(bins.size(), 1600u);
  EXPECT_DOUBLE_EQ(bins.first(), scan.angle_min);
  for (std::size_t i = 0; i < 1600; ++i) EXPECT_EQ(binAt(bins, degrees(scan.angle(i))), i);
}

TEST(ScanBins, OfAClockwiseScanRunCounterClockwise) {
  const Scan scan = scanOf(360, 180.0, -1.0);
  const ScanBins bins = ScanBins::about(scan);
  ASSERT_EQ(bins.size(), 360u);
  EXPECT_GT(bins.step(), 0.0);
  EXPECT_NEAR(degrees(bins.first()), -179.0, 1e-9);
  for (std::size_t i = 0; i < 360; ++i) EXPECT_EQ(binAt(bins, degrees(scan.angle(i))), 359 - i);
}

TEST(ScanBins, OfASectorGoAllTheWayRoundWithItInTheMiddle) {
  const Scan scan = scanOf(1081, -135.0, 0.25);
  const ScanBins bins = ScanBins::about(scan);
  ASSERT_EQ(bins.size(), 1440u);
  const std::size_t first = binAt(bins, -135.0);
  EXPECT_NEAR(static_cast<double>(first), (1440 - 1081) / 2, 1.0);
  for (std::size_t i = 0; i < 1081; ++i)
    EXPECT_EQ(binAt(bins, -135.0 + 0.25 * static_cast<double>(i)), first + i);
}

TEST(ScanBins, FirstAndLastBeamInOneDirectionShareABin) {
  const Scan scan = scanOf(361, -180.0, 1.0);
  const ScanBins bins = ScanBins::about(scan);
  EXPECT_EQ(bins.size(), 360u);
  EXPECT_EQ(binAt(bins, 180.0), binAt(bins, -180.0));
}

TEST(ScanBins, EveryDirectionFallsIntoOneOfThem) {
  for (const double step : {0.225, 0.25, 1.0, 7.0, 100.0, 0.35156})
    for (const double first : {-180.0, 0.0, 33.3, 350.0, -700.0}) {
      const ScanBins bins(radians(first), radians(step));
      for (int i = 0; i < 3600; ++i) {
        const std::size_t bin = binAt(bins, 0.1 * i);
        ASSERT_LT(bin, bins.size());
        const double middle = degrees(bins.first()) + static_cast<double>(bin) * degrees(bins.step());
        EXPECT_LE(std::abs(std::remainder(0.1 * i - middle, 360.0)), 0.5 * step + 0.001)
            << step << " " << first;
      }
    }
}

TEST(ScanBins, StepThatDoesNotDivideTheCircleKeepsItsSize) {
  const ScanBins bins(0.0, radians(7.0));
  EXPECT_NEAR(degrees(bins.step()), 7.0, 1e-9);
  EXPECT_EQ(bins.size(), 52u);
}

TEST(Scan, ReadingsFollowRep117AndForgiveOlderDrivers) {
  Scan scan = scanOf(0, 0.0, 1.0);
  scan.ranges = {0.2f, 10.f, kFree, kNear, kNaN, 11.f, 0.1f, 0.f, -1.f};
  const auto is = [&](std::size_t i) { return reading(scan, i); };
  EXPECT_EQ(is(0), 0.2f);
  EXPECT_EQ(is(1), 10.f);
  EXPECT_EQ(is(2), kFree);
  EXPECT_EQ(is(3), kNear);
  EXPECT_TRUE(std::isnan(is(4)));
  EXPECT_EQ(is(5), kFree) << "range_max + 1 was the old way to say nothing seen";
  for (const std::size_t nonsense : {6, 7, 8}) EXPECT_TRUE(std::isnan(is(nonsense)));
}

TEST(Scan, NearestWinsAndAnythingWinsOverNotLookedAt) {
  Scan scan = scanOf(1, 0.0, 1.0);
  scan.ranges = {kNaN};
  scan.intensities = {kNaN};
  mark(scan, 0, kFree, kNaN);
  EXPECT_EQ(scan.ranges[0], kFree);
  mark(scan, 0, 5.f, 50.f);
  mark(scan, 0, 7.f, 70.f);
  mark(scan, 0, kFree, kNaN);
  EXPECT_EQ(scan.ranges[0], 5.f);
  EXPECT_EQ(scan.intensities[0], 50.f);
  mark(scan, 0, kNear, kNaN);
  EXPECT_EQ(scan.ranges[0], kNear);
}

TEST(Scan, FaultsAreNamed) {
  const auto faulty = [](const std::function<void(Scan&)>& change) {
    Scan scan = scanOf(360, -180.0, 1.0);
    change(scan);
    return faultOf(scan);
  };
  EXPECT_EQ(faulty([](Scan&) {}), "");
  EXPECT_EQ(faulty([](Scan& s) { s.ranges.clear(); }), "");
  EXPECT_EQ(faulty([](Scan& s) { s.angle_increment *= -1.0; }), "");
  EXPECT_NE(faulty([](Scan& s) { s.angle_increment = 0.0; }), "");
  EXPECT_NE(faulty([](Scan& s) { s.angle_increment = 1e-12; }), "") << "would ask for endless memory";
  EXPECT_NE(faulty([](Scan& s) { s.angle_increment = std::nan(""); }), "");
  EXPECT_NE(faulty([](Scan& s) { s.angle_min = std::nan(""); }), "");
  EXPECT_NE(faulty([](Scan& s) { s.time_increment = -1.0; }), "");
  EXPECT_NE(faulty([](Scan& s) { s.scan_time = std::nan(""); }), "");
  EXPECT_NE(faulty([](Scan& s) { s.range_max = 0.1; }), "");
  EXPECT_NE(faulty([](Scan& s) { s.ranges.resize(720); }), "") << "two turns";
  EXPECT_EQ(faulty([](Scan& s) { s.intensities.resize(7); }), "scan damaged: 7 intensities for 360 ranges");
}

}  // namespace
}  // namespace field_fusion::core
