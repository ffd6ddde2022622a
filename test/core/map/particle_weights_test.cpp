#include "field_fusion/core/map/particle_weights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace field_fusion::core {
namespace {

TEST(ParticleWeights, AreNormalisedHoweverSmall) {
  const auto w = normalised({-1e6, -1e6 + std::log(3.0)});
  EXPECT_NEAR(w[0], 0.25, 1e-9);
  EXPECT_NEAR(w[1], 0.75, 1e-9);
  EXPECT_EQ(normalised({NAN, -HUGE_VAL, 0.0}), (std::vector<double>{0.0, 0.0, 1.0}));
  EXPECT_EQ(normalised({NAN, NAN}), (std::vector<double>{0.5, 0.5}));
}

TEST(ParticleWeights, EffectiveNumberAndEntropy) {
  EXPECT_NEAR(effectiveNumber({0.25, 0.25, 0.25, 0.25}), 4.0, 1e-12);
  EXPECT_NEAR(effectiveNumber({1.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(entropy({0.25, 0.25, 0.25, 0.25}), std::log(4.0), 1e-12);
  EXPECT_EQ(entropy({1.0, 0.0}), 0.0);
}

TEST(ParticleWeights, ResamplesInProportion) {
  for (const double u : {0.0, 0.3, 0.999}) {
    const auto from = resampled({0.5, 0.0, 0.25, 0.25}, u);
    EXPECT_EQ(from, (std::vector<std::size_t>{0, 0, 2, 3}));
  }
  EXPECT_EQ(resampled({0.0, 1.0}, 0.0), (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(resampled({1.0}, 0.5), (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace field_fusion::core
