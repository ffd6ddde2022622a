#include <gtest/gtest.h>

#include <cmath>

#include "field_fusion/core/sim/lanes.h"

namespace field_fusion::core::sim {
namespace {

TEST(Lanes, SinesAreThoseOfTheLibrary) {
  for (double angle = -400.0; angle < 400.0; angle += 0.0137) {
    const Sines s = sines(angle);
    ASSERT_NEAR(s.sine, std::sin(angle), 3e-10) << angle;
    ASSERT_NEAR(s.cosine, std::cos(angle), 3e-10) << angle;
  }
  for (const double angle : {0.0, 1e6, -1e6, 1.5707963267948966, 3.141592653589793}) {
    EXPECT_NEAR(sines(angle).sine, std::sin(angle), 4e-10);
    EXPECT_NEAR(sines(angle).cosine, std::cos(angle), 4e-10);
  }
  EXPECT_TRUE(std::isnan(sines(NAN).sine));
  EXPECT_TRUE(std::isnan(sines(INFINITY).cosine));
}

TEST(Lanes, QuickSineIsWithinAMillionth) {
  for (float angle = -3000.f; angle < 3000.f; angle += 0.113f)
    ASSERT_NEAR(quickSine(angle), std::sin(static_cast<double>(angle)), 1e-6) << angle;
  EXPECT_TRUE(std::isnan(quickSine(NAN)));
}

}  // namespace
}  // namespace field_fusion::core::sim
