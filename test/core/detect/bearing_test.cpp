#include "field_fusion/core/detect/bearing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace field_fusion::core {
namespace {

const Pinhole kCamera{500, 400, 320, 240};

TEST(Bearing, IsStraightAheadAtThePrincipalPoint) {
  const Bearing b = bearing({320, 240}, kCamera);
  EXPECT_TRUE(b.ray.isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(b.azimuth, 0, 1e-12);
  EXPECT_NEAR(b.elevation, 0, 1e-12);
}

// Paper 001 Eq. 5 with the sign of REP-103.
TEST(Bearing, CountsLeftAndUpPositive) {
  EXPECT_NEAR(bearing({320 - 500, 240}, kCamera).azimuth, radians(45), 1e-12);
  EXPECT_NEAR(bearing({320 + 500, 240}, kCamera).azimuth, radians(-45), 1e-12);
  EXPECT_NEAR(bearing({320, 240 - 400}, kCamera).elevation, radians(45), 1e-12);
  EXPECT_NEAR(bearing({320, 240 + 400}, kCamera).elevation, radians(-45), 1e-12);
}

TEST(Bearing, AgreesWithTheRayEverywhere) {
  for (double u = -100; u <= 740; u += 70)
    for (double v = -100; v <= 580; v += 85) {
      const Bearing b = bearing({u, v}, kCamera);
      EXPECT_NEAR(b.ray.norm(), 1, 1e-12);
      EXPECT_NEAR(b.ray.x() / b.ray.z() * kCamera.fx + kCamera.cx, u, 1e-9);
      EXPECT_NEAR(b.ray.y() / b.ray.z() * kCamera.fy + kCamera.cy, v, 1e-9);
      EXPECT_NEAR(b.azimuth, -std::atan((u - kCamera.cx) / kCamera.fx), 1e-12);
      EXPECT_NEAR(std::sin(b.elevation), -b.ray.y(), 1e-12);
    }
}

bool unknown(const Bearing& b) {
  return std::isnan(b.azimuth) && std::isnan(b.elevation) && b.ray.array().isNaN().all();
}

TEST(Bearing, IsNaNWithoutCameraModel) {
  for (const Pinhole& camera :
       {Pinhole{}, Pinhole{500, 0, 1, 1}, Pinhole{500, 400, kNaN, 1}, Pinhole{-5, 400, 1, 1}})
    EXPECT_TRUE(unknown(bearing({10, 10}, camera)));
}

TEST(Bearing, IsNaNForAPixelThatIsNone) {
  EXPECT_TRUE(unknown(bearing({kNaN, 10}, kCamera)));
  EXPECT_TRUE(unknown(bearing({10, HUGE_VAL}, kCamera)));
}

}  // namespace
}  // namespace field_fusion::core
