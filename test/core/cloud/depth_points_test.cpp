#include "field_fusion/core/cloud/depth_points.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

template <class Pixel>
Cloud pointsOf(const std::vector<Pixel>& pixels, int width, int step = 1) {
  Cloud out;
  const int height = static_cast<int>(pixels.size()) / width;
  depthPoints(
      DepthImage<Pixel>{width, height, pixels.data(), static_cast<std::size_t>(width), 2.0, 4.0, 1.0, 0.0},
      step, out);
  return out;
}

TEST(DepthPoints, LieWhereThePinholeSays) {
  const Cloud cloud = pointsOf<std::uint16_t>({0, 0, 2000, 0, 4000, 0}, 3);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_TRUE(cloud[0].position().isApprox(Eigen::Vector3f(1.f, 0.f, 2.f)));  // u = 2: (2 - 1) / 2 * 2 m
  EXPECT_TRUE(cloud[1].position().isApprox(Eigen::Vector3f(0.f, 1.f, 4.f)));  // v = 1: 1 / 4 * 4 m
}

TEST(DepthPoints, MetresAndMillimetresAreAlikeAndNonsenseIsNone) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Cloud cloud = pointsOf<float>({kNaN, kInf, 2.f, -1.f, 0.f, -kInf}, 3);
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_TRUE(cloud[0].position().isApprox(Eigen::Vector3f(1.f, 0.f, 2.f)));
}

TEST(DepthPoints, AStepLeavesOutPixelsAndRows) {
  EXPECT_EQ(pointsOf<std::uint16_t>(std::vector<std::uint16_t>(12, 1000), 4, 2).size(), 4u);
  EXPECT_TRUE(pointsOf<std::uint16_t>({}, 4).empty());
}

}  // namespace
}  // namespace field_fusion::core
