#include "field_fusion/core/base/histogram.h"

#include <gtest/gtest.h>

#include <cmath>

namespace field_fusion::core {
namespace {

TEST(Histogram, EmptyHasNoMedianAndNoText) {
  const Histogram histogram(0.0, 1.0, 4);
  EXPECT_TRUE(std::isnan(histogram.median()));
  EXPECT_EQ(histogram.text(1.0), "");
}

TEST(Histogram, LowerEdgeBelongsToABinAndBothEndsAreKept) {
  Histogram histogram(-1.0, 0.5, 4);
  for (const double value : {-1.0, -0.5, -7.0, 1.0, double(INFINITY), -0.51}) histogram.add(value);
  histogram.add(NAN);
  EXPECT_EQ(histogram.text(10.0), "below -10: 1, -10..-5: 2, -5..0: 1, above 10: 2");
  EXPECT_EQ(histogram.count(), 6u);
}

TEST(Histogram, MedianIsTheMiddleOfItsBin) {
  Histogram histogram(0.0, 2.0, 3);
  for (const double value : {0.1, 3.9, 3.0, 3.1, 5.0}) histogram.add(value);
  EXPECT_EQ(histogram.median(), 3.0);
  for (int i = 0; i < 10; ++i) histogram.add(100.0);
  EXPECT_EQ(histogram.median(), 6.0);
  histogram.reset();
  EXPECT_EQ(histogram.count(), 0u);
}

}  // namespace
}  // namespace field_fusion::core
