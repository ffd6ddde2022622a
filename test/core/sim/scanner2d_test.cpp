#include "field_fusion/core/sim/scanner2d.h"

#include <gtest/gtest.h>

#include "support/sim_worlds.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// LMS141 without its errors; a spot of the size in the data sheet.
Scanner2dParams perfect() {
  Scanner2dParams p;
  p.beam.ten_percent_range = 1000.0;
  p.beam.energy_noise = p.beam.range_noise = p.beam.slant_noise = p.beam.range_bias = p.beam.range_step = 0.0;
  return p;
}

World oneWall() { return test::worldOf({test::wallAhead("wall", 5.f, -1000.f, 1000.f, test::matt(0.9f))}); }

/// The edge of a wall at y = 0 before another one, both giving as much energy.
World edge(float near, float gap) {
  const float fainter = near * near / ((near + gap) * (near + gap));
  return test::worldOf({test::wallAhead("near", near, -50.f, 0.f, test::matt(0.9f * fainter)),
                        test::wallAhead("far", near + gap, -80.f, 80.f, test::matt(0.9f))});
}

TEST(Scanner2d, OfTheLms141Has541BeamsWithin15Milliseconds) {
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(perfect(), 1);
  const Scan2d& scan = scanner.scan(caster, test::standing(), 3.0);
  EXPECT_EQ(scan.ranges.size(), 541u);
  EXPECT_EQ(scan.stamp, 3.0);
  EXPECT_FLOAT_EQ(scan.angle_min, static_cast<float>(radians(-135.0)));
  EXPECT_FLOAT_EQ(scan.angle_max, static_cast<float>(radians(135.0)));
  EXPECT_FLOAT_EQ(scan.angle_increment, static_cast<float>(radians(0.5)));
  EXPECT_NEAR(scan.time_increment * 540, 0.015, 1e-8);
  EXPECT_FLOAT_EQ(scan.scan_time, 0.02f);
}

TEST(Scanner2d, OfAFullTurnDoesNotRepeatItsFirstBeam) {
  Scanner2dParams p = perfect();
  p.rate = 10.0, p.field_of_view = 360.0, p.angle_step = 0.225;
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(p, 1);
  const Scan2d& scan = scanner.scan(caster, test::standing(), 0.0);
  EXPECT_EQ(scan.ranges.size(), 1600u);
  EXPECT_FLOAT_EQ(scan.time_increment, 62.5e-6f);
  EXPECT_FLOAT_EQ(scan.angle_max, static_cast<float>(radians(180.0 - 0.225)));
}

TEST(Scanner2d, AtOnceSeesWhileItTurnsWhatItSeesStanding) {
  const World world = oneWall();
  Caster caster(world);
  Scanner2dParams p = perfect();
  p.at_once = true;
  const auto turning = test::turning(3.0);
  const Scan2d turned = Scanner2d(p, 1).scan(caster, turning, 0.0);
  EXPECT_EQ(turned.time_increment, 0.f);
  EXPECT_FLOAT_EQ(turned.scan_time, 0.02f);
  EXPECT_EQ(turned.ranges, Scanner2d(p, 1).scan(caster, test::standing(), 0.0).ranges);
  EXPECT_NE(turned.ranges, Scanner2d(perfect(), 1).scan(caster, turning, 0.0).ranges);
}

TEST(Scanner2d, StandingMeasuresAWallExactly) {
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(perfect(), 1);
  const double yaw = 0.3;
  const Scan2d& scan = scanner.scan(caster, test::standing(yaw), 0.0);
  int seen = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle = scan.angle_min + i * static_cast<double>(scan.angle_increment) + yaw;
    const double expected = std::cos(angle) > 0.0 ? 5.0 / std::cos(angle) : kInf;
    if (expected > 39.9) continue;
    EXPECT_NEAR(scan.ranges[i], expected, 1e-5 * expected);
    ++seen;
  }
  EXPECT_GT(seen, 300);
}

/// The beam at angle a leaves at time t and meets the wall x = 5 under a + w t.
void expectBent(const Scan2d& scan, double rate, double tolerance) {
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle = scan.angle_min + i * static_cast<double>(scan.angle_increment);
    const double now = angle + rate * i * static_cast<double>(scan.time_increment);
    if (std::abs(now) > radians(80.0)) continue;
    EXPECT_NEAR(scan.ranges[i], 5.0 / std::cos(now), tolerance * 5.0 / std::cos(now)) << i;
  }
}

TEST(Scanner2d, TurningBendsAWallByTheAnalyticAmount) {
  Scanner2dParams p = perfect();
  p.rate = 10.0, p.field_of_view = 360.0, p.angle_step = 0.225;
  const World world = oneWall();
  Caster caster(world);
  const double rate = radians(90.0);
  Scanner2d left(p, 1);
  expectBent(left.scan(caster, test::turning(rate), 0.0), rate, 1e-5);
  p.clockwise = true;
  Scanner2d right(p, 1);
  expectBent(right.scan(caster, test::turning(rate), 0.0), rate, 1e-5);
}

TEST(Scanner2d, TurningBendsAWallAsMuchWithNoise) {
  Scanner2dParams p = perfect();
  p.rate = 10.0, p.field_of_view = 360.0, p.angle_step = 0.225, p.beam.range_noise = 0.01;
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(p, 1);
  const double rate = radians(90.0);
  const Scan2d& scan = scanner.scan(caster, test::turning(rate), 0.0);
  std::vector<double> errors, if_it_stood;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle = scan.angle_min + i * static_cast<double>(scan.angle_increment);
    const double now = angle + rate * i * static_cast<double>(scan.time_increment);
    if (std::abs(now) > radians(60.0)) continue;
    errors.push_back(scan.ranges[i] - 5.0 / std::cos(now));
    if_it_stood.push_back(scan.ranges[i] - 5.0 / std::cos(angle));
  }
  const auto found = test::spreadOf(errors);
  EXPECT_NEAR(found.mean, 0.0, 4.0 * 0.01 / std::sqrt(found.count));
  EXPECT_NEAR(found.sigma, 0.01, 4.0 * 0.01 / std::sqrt(2.0 * found.count));
  EXPECT_GT(test::spreadOf(if_it_stood).sigma, 0.1);  // what the bend alone makes
}

TEST(Scanner2d, AngleNoiseSpreadsTheRangesOfASlantingWall) {
  Scanner2dParams p = perfect();
  p.beam.angle_noise = 0.1, p.beam.spot_sampling = SpotSampling::kNever;
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(p, 1);
  std::vector<double> at_45;
  for (int i = 0; i < 2000; ++i) at_45.push_back(scanner.scan(caster, test::standing(), i).ranges[360]);
  // r = 5 / cos a: dr/da = r tan a
  const double sigma = radians(0.1) * 5.0 * std::sqrt(2.0);
  EXPECT_NEAR(test::spreadOf(at_45).sigma, sigma, 4.0 * sigma / std::sqrt(4000.0));
}

TEST(Scanner2d, AnswersAsRep117) {
  const World world = test::worldOf({test::wallAhead("near", 0.3f, -0.01f, 0.01f, test::matt(0.9f)),
                                     test::wallAhead("far", 5.f, 1.f, 2.f, test::matt(0.9f))});
  Caster caster(world);
  Scanner2d scanner(perfect(), 1);
  const Scan2d& scan = scanner.scan(caster, test::standing(), 0.0);
  EXPECT_EQ(scan.ranges[270], -kInf);
  EXPECT_EQ(scan.ranges[0], kInf);
  EXPECT_NEAR(scan.ranges[270 + 34], 5.0 / std::cos(radians(17.0)), 1e-4);
  EXPECT_EQ(scanner.truth()[270 + 34].body, 1);
  EXPECT_EQ(scanner.truth()[0].body, Hit::kNothing);
}

/// Area of an even disc of radius 1 that lies beyond a chord at distance x from its middle, as a share.
double beyondChord(double x) {
  if (std::abs(x) >= 1.0) return x < 0.0 ? 1.0 : 0.0;
  return (std::acos(x) - x * std::sqrt(1.0 - x * x)) / radians(180.0);
}

/// Of spots that an edge cuts, the share in which nine rays at random come to lie on both sides.
double foundByNineRays() {
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double share = beyondChord(-1.0 + 0.002 * (i + 0.5));
    sum += 1.0 - std::pow(share, 9) - std::pow(1.0 - share, 9);
  }
  return sum / 1000.0;
}

/// Where the edge lies within the spot of each beam (-1 .. 1), over many yaws of the scanner.
struct EdgeBeams {
  std::vector<double> place, range;
  double mixed = 0.0, scans = 0.0;
};

EdgeBeams beamsAtEdge(const Scanner2dParams& params, float near, float gap) {
  const World world = edge(near, gap);
  Caster caster(world);
  Scanner2d scanner(params, 1);
  EdgeBeams out;
  for (int i = 0; i < 2000; ++i, out.scans += 1.0) {
    const double yaw = radians(-0.25 + 0.5 * i / 2000.0);
    const Scan2d& scan = scanner.scan(caster, test::standing(yaw), i);
    for (int beam = 266; beam <= 274; ++beam) {
      const double side = near * std::tan(radians(0.5 * (beam - 270)) + yaw);
      const double place = side / (0.5 * spotSize(params.beam, near).x());
      out.mixed += scanner.truth()[beam].mixed;
      if (std::abs(place) < 1.1) out.place.push_back(place), out.range.push_back(scan.ranges[beam]);
      EXPECT_FALSE(std::abs(place) > 1.02 && scanner.truth()[beam].mixed) << place;
    }
  }
  return out;
}

TEST(Scanner2d, MixesRangesAtAnEdgeByTheShareOfTheSpot) {
  Scanner2dParams p = perfect();
  p.beam.pulse_length = 1.0;
  constexpr float kNear = 10.f, kGap = 0.4f;
  const EdgeBeams beams = beamsAtEdge(p, kNear, kGap);
  ASSERT_GT(beams.place.size(), 3000u);
  std::vector<double> errors;
  for (std::size_t i = 0; i < beams.place.size(); ++i)
    errors.push_back(beams.range[i] - kNear - kGap * beyondChord(-beams.place[i]));
  const auto found = test::spreadOf(errors);
  EXPECT_NEAR(found.mean, 0.0, 0.01 * kGap);
  EXPECT_LT(found.sigma, kGap / 9.0);  // nine rays, one of each ninth of the spot
  const double cut = spotSize(p.beam, kNear).x() / (kNear * radians(0.5));  // spot width over beam spacing
  EXPECT_NEAR(beams.mixed / beams.scans, cut * foundByNineRays(),
              0.05 * cut);  // in step they find a few more
}

TEST(Scanner2d, BeyondThePulseTheStrongerSideOfAnEdgeWins) {
  const EdgeBeams beams = beamsAtEdge(perfect(), 10.f, 2.f);
  EXPECT_EQ(beams.mixed, 0.0);
  for (std::size_t i = 0; i < beams.place.size(); ++i) {
    if (std::abs(beams.place[i]) < 0.5) continue;
    EXPECT_NEAR(beams.range[i], beams.place[i] < 0.0 ? 10.0 : 12.0, 0.01) << beams.place[i];
  }
}

TEST(Scanner2d, SpotsAtEdgesOnlySeeWhatAllSpotsWould) {
  Scanner2dParams p = perfect();
  const World world = edge(8.f, 0.5f);
  Caster caster(world);
  Scanner2d some(p, 1);
  p.beam.spot_sampling = SpotSampling::kAlways;
  Scanner2d all(p, 1);
  EXPECT_EQ(some.scan(caster, test::standing(), 0.0).ranges, all.scan(caster, test::standing(), 0.0).ranges);
}

/// Everything that a LiDAR can do wrong.
Scanner2dParams faulty() {
  Scanner2dParams p;
  p.beam.range_noise_weak = 0.01, p.beam.angle_noise = 0.05, p.beam.fault_rate = 0.01;
  return p;
}

std::vector<float> faultyScan(std::uint64_t seed, int threads, double stamp = 0.0) {
  Scanner2dParams p = faulty();
  p.beam.threads = threads;
  const World world = edge(8.f, 0.5f);
  Caster caster(world);
  Scanner2d scanner(p, seed);
  scanner.scan(caster, test::turning(0.5), 10.0);  // what was scanned before has no say
  std::vector<float> out = scanner.scan(caster, test::turning(0.5), stamp).ranges;
  for (float& r : out) r = std::isnan(r) ? -1.f : r;  // NaN equals nothing
  return out;
}

TEST(Scanner2d, IsTheSameForASeedAndAnotherForAnother) {
  EXPECT_EQ(faultyScan(1, 1), faultyScan(1, 1));
  EXPECT_NE(faultyScan(1, 1), faultyScan(2, 1));
  EXPECT_NE(faultyScan(1, 1), faultyScan(1, 1, 0.02));
}

TEST(Scanner2d, DoesNotDependOnTheNumberOfThreads) {
  EXPECT_EQ(faultyScan(1, 1), faultyScan(1, 3));
  EXPECT_EQ(faultyScan(1, 1), faultyScan(1, 16));
}

TEST(Scanner2d, RefusesParametersThatMakeNoScanner) {
  const auto refused = [](auto change) {
    Scanner2dParams p;
    change(p);
    EXPECT_THROW(Scanner2d(p, 1), std::invalid_argument);
  };
  refused([](auto& p) { p.rate = 0.0; });
  refused([](auto& p) { p.rate = kNaN; });
  refused([](auto& p) { p.angle_step = 0.0; });
  refused([](auto& p) { p.angle_step = 0.7; });  // no whole number of steps
  refused([](auto& p) { p.beam.min_range = 50.0; });
  refused([](auto& p) { p.beam.range_noise = -0.1; });
  refused([](auto& p) { p.beam.fault_rate = 1.5; });
}

TEST(Scanner2d, RefusesAStampThatIsNoTime) {
  const World world = oneWall();
  Caster caster(world);
  Scanner2d scanner(perfect(), 1);
  EXPECT_THROW(scanner.scan(caster, test::standing(), std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
