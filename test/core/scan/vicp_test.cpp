#include "field_fusion/core/scan/vicp.h"

#include <gtest/gtest.h>

#include "field_fusion/core/scan/deskew.h"
#include "support/moving_scanner.h"

namespace field_fusion::core {
namespace {

using test::Room;
using test::Scanner;

Scanner coarse() {
  Scanner out;
  out.beams = 720;
  return out;
}

/// In the plane, as VICP assumes: velocity and turn in the scanner's own frame.
test::Motion constantTwist(const PlanarVelocity& v) {
  return [v](double time) { return keptOn({v.x, v.y, 0.0}, {0.0, 0.0, v.turn}, time); };
}

Cloud scanAt(const test::Motion& motion, double stamp) {
  const Scan scan = coarse().scan({}, motion, stamp);
  Cloud points;
  scanPoints(scan, 0.0, scan.time_increment, points);
  return points;
}

TEST(Vicp, FindsTheVelocityOfASteadyMotionOutOfTheScansAlone) {
  for (const auto metric : {VicpParams::Metric::kPoint, VicpParams::Metric::kLine}) {
    VicpParams params;
    params.metric = metric;
    params.iterations = 100;
    Vicp vicp(params);
    const PlanarVelocity truth{0.8, -0.1, radians(30.0)};
    std::optional<PlanarVelocity> found;
    for (int i = 0; i < 6; ++i) found = vicp.run(scanAt(constantTwist(truth), 0.1 * i), 0.1 * i);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, truth.x, 0.05);
    EXPECT_NEAR(found->y, truth.y, 0.05);
    EXPECT_NEAR(degrees(found->turn), 30.0, 1.0);
  }
}

TEST(Vicp, StandingStillIsNoVelocity) {
  Vicp vicp;
  const auto still = constantTwist({});
  vicp.run(scanAt(still, 0.0), 0.0);
  const auto found = vicp.run(scanAt(still, 0.1), 0.1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->x, 0.0, 1e-6);
  EXPECT_NEAR(found->turn, 0.0, 1e-6);
  EXPECT_EQ(vicp.updates(), 1);
}

TEST(Vicp, FirstScanSilenceAndTimeGoingBackGiveNone) {
  Vicp vicp;
  const Cloud scan = scanAt(constantTwist({}), 0.0);
  EXPECT_FALSE(vicp.run(scan, 10.0));
  EXPECT_TRUE(vicp.run(scan, 10.1));
  EXPECT_FALSE(vicp.run(scan, 11.0));
  EXPECT_FALSE(vicp.run(scan, 10.9));
  EXPECT_FALSE(vicp.run(scan, 10.9)) << "two scans of one stamp";
  vicp.reset();
  EXPECT_FALSE(vicp.run(scan, 11.0));
}

TEST(Vicp, ScansThatDoNotLieTogetherGiveNone) {
  Vicp vicp;
  Cloud far = scanAt(constantTwist({}), 0.0);
  vicp.run(far, 0.0);
  for (Point& p : far) p.x += 50.f;
  EXPECT_FALSE(vicp.run(far, 0.1));
}

TEST(Vicp, EmptyAndSinglePointsGiveNone) {
  Vicp vicp;
  Cloud one(1);
  one[0].time = 0.f;
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(vicp.run(i % 2 ? one : Cloud{}, 0.1 * i));
  EXPECT_FALSE(vicp.run(scanAt(constantTwist({}), 0.0), 0.4));
}

TEST(PlanarMotion, AndItsVelocityAreInverse) {
  for (const double turn : {0.0, 1e-9, 0.5, -2.0}) {
    const PlanarVelocity v{1.0, -0.3, turn};
    const auto back = planarVelocity(planarMotion(v, 0.7), 0.7);
    EXPECT_NEAR(back.x, v.x, 1e-9);
    EXPECT_NEAR(back.y, v.y, 1e-9);
    EXPECT_NEAR(back.turn, v.turn, 1e-9);
  }
  // half a circle of radius 1/pi
  const auto half = planarMotion({1.0, 0.0, radians(180.0)}, 1.0);
  EXPECT_NEAR(half.translation().x(), 0.0, 1e-9);
  EXPECT_NEAR(half.translation().y(), 2.0 / radians(180.0), 1e-9);
}

}  // namespace
}  // namespace field_fusion::core
