#include "field_fusion/core/cloud/voxel.h"

#include <gtest/gtest.h>

#include <map>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

Cloud thinned(const Cloud& cloud, double side) {
  Cloud out;
  Voxels().run(cloud, side, out);
  return out;
}

TEST(Voxels, KeepsThePointNearestTheCentroidAsItWasMeasured) {
  Cloud cloud{at(0.1f, 0.1f), at(0.45f, 0.5f), at(0.9f, 0.9f)};
  cloud[1].ring = 7, cloud[1].time = 0.05f, cloud[1].intensity = 42.f;
  const Cloud out = thinned(cloud, 1.0);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].position(), cloud[1].position());
  EXPECT_EQ(out[0].ring, 7);
  EXPECT_EQ(out[0].time, 0.05f);
  EXPECT_EQ(out[0].intensity, 42.f);
}

TEST(Voxels, OfTwoEquallyNearKeepsTheEarlier) {
  EXPECT_EQ(thinned({at(0.75f, 0), at(0.25f, 0)}, 1.0)[0].x, 0.75f);
}

TEST(Voxels, CubesMeetAtZeroAndHoldTheirLowerFace) {
  EXPECT_EQ(thinned({at(-0.1f, 0), at(0.1f, 0)}, 1.0).size(), 2u);
  EXPECT_EQ(thinned({at(0.f, 0), at(0.5f, 0)}, 0.5).size(), 2u);
}

TEST(Voxels, KeepsTheOrderOfTheCloud) {
  const Cloud out = thinned({at(9, 0), at(-9, 0), at(0.5f, 0), at(9.1f, 0)}, 1.0);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[0].x, 9.f);
  EXPECT_EQ(out[1].x, -9.f);
  EXPECT_EQ(out[2].x, 0.5f);
}

TEST(Voxels, EachOccupiedCubeKeepsExactlyOnePoint) {
  const Cloud cloud = test::fillBox(5000, {-10.f, -10.f, -2.f}, {10.f, 10.f, 2.f});
  const auto cube = [](const Point& p) {
    return std::array<double, 3>{std::floor(p.x / 0.7), std::floor(p.y / 0.7), std::floor(p.z / 0.7)};
  };
  std::map<std::array<double, 3>, int> expected, kept;
  for (const Point& p : cloud) expected[cube(p)] = 1;
  for (const Point& p : thinned(cloud, 0.7)) ++kept[cube(p)];
  EXPECT_EQ(kept, expected);
}

// 10^18 cubes lie between these points: a 32-bit cube number would have run over.
TEST(Voxels, FarApartPointsDoNotOverflow) {
  const Cloud cloud{at(-1e4f, -1e4f, -1e4f), at(1e4f, 1e4f, 1e4f), at(0, 0)};
  EXPECT_EQ(thinned(cloud, 0.01).size(), 3u);
}

TEST(Voxels, DropsUnusablePoints) {
  EXPECT_TRUE(thinned({at(kNaN, 0), at(0, INFINITY), at(0, 0, 3e38f)}, 1.0).empty());
  EXPECT_TRUE(thinned({}, 1.0).empty());
}

TEST(Voxels, EqualPointsBecomeOne) { EXPECT_EQ(thinned(Cloud(100000, at(1, 2, 3)), 0.1).size(), 1u); }

}  // namespace
}  // namespace field_fusion::core
