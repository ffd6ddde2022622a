#include "field_fusion/core/sim/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace field_fusion::core::sim {
namespace {

CameraParams automatic() {
  CameraParams p;
  p.brightness = 0.2, p.exposure_delay = 0.5, p.exposure_time = p.white_time = 2.0;
  p.max_exposure_time = 20.0, p.max_gain = 20.0;
  return p;
}

TEST(Exposure, ErrorFallsByItsTimeConstant) {
  Exposure exposure(automatic());
  const double light = 0.8;  // at scale 1: four times too bright
  exposure.follow(light * exposure.scale(), 0.5);
  EXPECT_NEAR(std::log(light * exposure.scale() / 0.2), std::log(4.0) * std::exp(-1.0), 1e-9);
  for (int i = 0; i < 100; ++i) exposure.follow(light * exposure.scale(), 0.1);
  EXPECT_NEAR(light * exposure.scale(), 0.2, 1e-6);
  EXPECT_NEAR(exposure.time(), 0.0005, 1e-9);
}

TEST(Exposure, WithoutDelayTheNextPictureIsRight) {
  CameraParams p = automatic();
  p.exposure_delay = 0.0;
  Exposure exposure(p);
  exposure.follow(0.1, 0.01);
  EXPECT_NEAR(exposure.scale(), 2.0, 1e-9);
}

TEST(Exposure, GainComesWhenTheTimeIsUsedUpAndEnds) {
  Exposure exposure(automatic());
  for (int i = 0; i < 100; ++i) exposure.follow(0.004 * exposure.scale(), 1.0);  // wants scale 50
  EXPECT_NEAR(exposure.time(), 0.02, 1e-12);
  EXPECT_NEAR(exposure.gain(), 5.0, 1e-6);
  for (int i = 0; i < 100; ++i) exposure.follow(0.0, 1.0);
  EXPECT_NEAR(exposure.gain(), 10.0, 1e-9);
}

TEST(Exposure, FixedStaysAndNaNIsNoBrightness) {
  CameraParams p = automatic();
  Exposure follows(p);
  follows.follow(std::nan(""), 1.0);
  EXPECT_EQ(follows.scale(), 1.0);
  p.auto_exposure = false, p.gain = 6.0;
  Exposure fixed(p);
  fixed.follow(0.9, 1.0);
  EXPECT_NEAR(fixed.scale(), std::pow(10.0, 0.3), 1e-12);
}

}  // namespace
}  // namespace field_fusion::core::sim
