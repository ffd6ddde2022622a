#include "field_fusion/core/io/hdl64.h"

#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

TEST(Hdl64Ring, IsTheNominalBeam) {
  for (int i = 0; i < 32; ++i) {
    EXPECT_EQ(hdl64Ring(radians(-24.33 + i / 2.0)), i);
    EXPECT_EQ(hdl64Ring(radians(-8.33 + i / 3.0)), 32 + i);
  }
}

TEST(Hdl64Ring, GrowsWithElevation) {
  for (double angle = -30.0; angle < 10.0; angle += 0.01)
    ASSERT_LE(hdl64Ring(radians(angle)), hdl64Ring(radians(angle + 0.01))) << angle;
}

TEST(Hdl64Ring, BeyondTheFieldOfViewIsTheOutermost) {
  EXPECT_EQ(hdl64Ring(radians(-90.0)), 0);
  EXPECT_EQ(hdl64Ring(radians(90.0)), 63);
}

TEST(Hdl64Ring, IsUnknownForNaN) { EXPECT_EQ(hdl64Ring(NAN), kUnknownRing); }

TEST(TurnTime, IsZeroAheadAndGrowsCounterClockwise) {
  EXPECT_FLOAT_EQ(turnTime(0.0), 0.f);
  EXPECT_FLOAT_EQ(turnTime(radians(90.0)), 0.025f);
  EXPECT_FLOAT_EQ(turnTime(radians(-90.0)), -0.025f);
  EXPECT_FLOAT_EQ(turnTime(radians(90.0), 0.2), 0.05f);
}

TEST(TurnTime, EndsBehind) {
  EXPECT_FLOAT_EQ(std::abs(turnTime(radians(180.0))), 0.05f);
  EXPECT_FLOAT_EQ(turnTime(radians(190.0)), turnTime(radians(-170.0)));
}

TEST(TurnTime, IsNaNForNaN) { EXPECT_TRUE(std::isnan(turnTime(NAN))); }

}  // namespace
}  // namespace field_fusion::core
