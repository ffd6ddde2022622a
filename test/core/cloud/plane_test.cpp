#include "field_fusion/core/cloud/plane.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

std::vector<std::uint32_t> allOf(const Cloud& cloud) {
  std::vector<std::uint32_t> out(cloud.size());
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

bool any(Plane&) { return true; }

bool find(const Cloud& cloud, Plane& plane, const PlaneSearch::Accept& accept = any, unsigned seed = 1) {
  PlaneSearch search;
  search.sample(cloud, allOf(cloud), seed);
  return search.run(0.1, 1000, accept, plane);
}

TEST(Plane, HeightIsPositiveOnTheSideOfTheNormal) {
  const Plane plane{Eigen::Vector3d::UnitZ(), 1.7};
  EXPECT_DOUBLE_EQ(plane.height({5, 5, 0}), 1.7);
  EXPECT_DOUBLE_EQ(plane.height({5, 5, -2}), 2.0 - 2.3);
}

TEST(PlaneFit, PassesThroughPointsOfAPlane) {
  PlaneFit fit({0, 0, 0});
  for (const Point& p : test::floor(200, -2.f, 0.1f)) fit.add(p.position().cast<double>());
  const auto [plane, thickness, width] = fit.solve();
  const Eigen::Vector3d expected = Eigen::Vector3d(-0.1, 0.0, 1.0).normalized();
  EXPECT_NEAR(std::abs(plane.normal.dot(expected)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(plane.height({0, 0, -2})), 0.0, 1e-6);
  EXPECT_NEAR(thickness, 0.0, 1e-6);
  EXPECT_GT(width, 10.0);
}

TEST(PlaneFit, KeepsItsPrecisionFarFromTheOrigin) {
  const Eigen::Vector3d far(1e6, -2e6, 3e5);
  PlaneFit fit(far);
  for (const Point& p : test::floor(200, 0.f, 0.f, 0.01f)) fit.add(far + p.position().cast<double>());
  const auto result = fit.solve();
  EXPECT_NEAR(result.thickness, 0.01, 0.002);
  EXPECT_NEAR(std::abs(result.plane.normal.z()), 1.0, 1e-5);
}

TEST(PlaneFit, PointsOnALineHaveNoWidth) {
  PlaneFit fit({0, 0, 0});
  for (int i = 0; i < 50; ++i) fit.add({0.5 * i, 0.25 * i, 0.0});
  EXPECT_NEAR(fit.solve().width, 0.0, 1e-6);
}

TEST(PlaneSearch, FindsThePlaneAmongFourTimesAsManyOthers) {
  const Cloud cloud =
      test::join({test::floor(500, -1.5f), test::fillBox(2000, {-20, -20, -10}, {20, 20, 10})});
  Plane plane;
  ASSERT_TRUE(find(cloud, plane));
  EXPECT_NEAR(std::abs(plane.normal.z()), 1.0, 1e-3);
  EXPECT_NEAR(std::abs(plane.offset), 1.5, 0.05);
}

TEST(PlaneSearch, SameSeedGivesTheSamePlane) {
  const Cloud cloud = test::floor(5000, -1.5f, 0.05f, 0.05f);
  Plane a, b;
  ASSERT_TRUE(find(cloud, a) && find(cloud, b));
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.offset, b.offset);
}

TEST(PlaneSearch, TakesOnlyWhatIsAccepted) {
  const Cloud cloud = test::join({test::floor(2000, -1.5f), test::floor(500, -4.f)});
  Plane plane;
  ASSERT_TRUE(
      find(cloud, plane, [](Plane& p) { return std::abs(p.offset) > 3.9 && std::abs(p.offset) < 4.1; }));
  EXPECT_NEAR(std::abs(plane.offset), 4.0, 1e-3);
  EXPECT_FALSE(find(cloud, plane, [](Plane&) { return false; }));
}

TEST(PlaneSearch, FindsNoneWhereNoTripleSpansOne) {
  Plane plane;
  EXPECT_FALSE(find({}, plane));
  EXPECT_FALSE(find({at(0, 0), at(1, 0)}, plane));
  EXPECT_FALSE(find(Cloud(500, at(1, 2, 3)), plane));
  EXPECT_FALSE(find(test::line(500, 0.1f), plane));
}

}  // namespace
}  // namespace field_fusion::core
