#include "field_fusion/core/map/ray.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace field_fusion::core {
namespace {

using Cells = std::vector<std::pair<int, int>>;

Cells cells(double x0, double y0, double x1, double y1) {
  Cells out;
  traverse(x0, y0, x1, y1, [&](int x, int y) { out.emplace_back(x, y); });
  return out;
}

TEST(Ray, GoesThroughTheCellsThatItsPointsLieIn) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-40.0, 40.0);
  for (int k = 0; k < 300; ++k) {
    const double x0 = place(random), y0 = place(random), x1 = place(random), y1 = place(random);
    const Cells found = cells(x0, y0, x1, y1);
    const std::set<std::pair<int, int>> unique(found.begin(), found.end());
    EXPECT_EQ(unique.size(), found.size());
    constexpr int kSamples = 20000;
    for (int i = 0; i <= kSamples; ++i) {
      const double t = i / double{kSamples};
      const std::pair<int, int> at(static_cast<int>(std::floor(x0 + t * (x1 - x0))),
                                   static_cast<int>(std::floor(y0 + t * (y1 - y0))));
      ASSERT_TRUE(unique.count(at)) << at.first << " " << at.second;
    }
    // a straight way enters |dx| + |dy| + 1 cells, so there are none beside those sampled
    const int expected = std::abs(found.back().first - found.front().first) +
                         std::abs(found.back().second - found.front().second) + 1;
    EXPECT_EQ(static_cast<int>(found.size()), expected);
  }
}

TEST(Ray, AlongAnAxisAndOfNoLength) {
  EXPECT_EQ(cells(0.5, 0.5, 0.5, 0.5), (Cells{{0, 0}}));
  EXPECT_EQ(cells(0.5, 0.5, 3.5, 0.5), (Cells{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(cells(0.5, 0.5, 0.5, -1.5), (Cells{{0, 0}, {0, -1}, {0, -2}}));
}

TEST(Ray, StepsBySidesThroughCorners) {
  for (const Cells& found : {cells(0.0, 0.0, 5.0, 5.0), cells(5.0, 5.0, 0.0, 0.0), cells(0.0, 3.0, 3.0, 0.0)})
    for (std::size_t i = 1; i < found.size(); ++i)
      EXPECT_EQ(std::abs(found[i].first - found[i - 1].first) + std::abs(found[i].second - found[i - 1].second), 1);
}

}  // namespace
}  // namespace field_fusion::core
