#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "field_fusion/core/sim/caster.h"
#include "test_world.h"

namespace field_fusion::core::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// In a vector, because GCC 12 leaves out the rounding to float of a ray whose making and use it sees at
/// once.
std::vector<Ray> randomRays(std::size_t count, unsigned seed, double around, double height) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const double x = around + 20 * unit(random), y = around + 20 * unit(random);
    const double ahead = unit(random), left = unit(random), up = 0.5 * unit(random) - 0.3;
    rays.push_back(
        {Vector3d(x, y, height).cast<float>(), Vector3d(ahead, left, up).normalized().cast<float>()});
  }
  return rays;
}

/// Where the height above the ground first changes its sign, by small steps and then halving.
double slowRange(const Ground& ground, const Ray& ray, double time) {
  const Vector3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
  const auto above = [&](double t) {
    const Vector3d p = o + t * d;
    return p.z() - ground.height(p.x(), p.y(), time);
  };
  double before = 0.0;
  for (double t = 0.0; t < 100.0; before = t, t += 0.01) {
    if (above(t) > 0.0) continue;
    for (double low = before, high = t;;) {
      const double middle = 0.5 * (low + high);
      if (high - low < 1e-9) return middle;
      (above(middle) > 0.0 ? low : high) = middle;
    }
  }
  return INFINITY;
}

class NearAndFarGround : public testing::TestWithParam<double> {};

TEST_P(NearAndFarGround, SlopedPlaneIsWhereTheFormulaSays) {
  World world;
  world.ground.slope = {0.05, -0.02};
  const Caster caster(world);
  const double height = world.ground.height(GetParam(), GetParam(), 0) + 3;
  int met = 0;
  for (const Ray& ray : randomRays(2000, 4, GetParam(), height)) {
    const Vector3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
    const double range =
        (world.ground.height(o.x(), o.y(), 0) - o.z()) / (d.z() - world.ground.slope.dot(d.head<2>()));
    const Hit hit = caster.cast(ray);
    if (range < 0.0) {
      EXPECT_EQ(hit.body, Hit::kNothing);
      continue;
    }
    ++met;
    EXPECT_EQ(hit.body, Hit::kGround);
    EXPECT_NEAR(hit.range, range, 1e-5 * range);
    EXPECT_TRUE(hit.normal.isApprox(Vector3f(-0.05f, 0.02f, 1.f).normalized(), 1e-5f));
    EXPECT_EQ(hit.material, &world.ground.material);
  }
  EXPECT_GT(met, 1000);
}

World sea() {
  World world;
  world.ground.kind = Ground::Kind::kWater;
  world.ground.waves = {
      {0.2, 9, 0.3, 0.1}, {0.1, 5, -0.5, 2}, {0.05, 2.5, 1.2, 4}, {0.03, 1.7, 2.2, 1}, {0.02, 1.1, 0, 5}};
  return world;
}

TEST_P(NearAndFarGround, WaterIsWhereItsHeightIs) {
  const World world = sea();
  Caster caster(world);
  caster.setWindow(30.0, 30.2);
  std::vector<Ray> rays = randomRays(1000, 6, GetParam(), 1.2);
  int met = 0;
  for (Ray& ray : rays) {
    ray.time = 0.5f;
    const double range = slowRange(world.ground, ray, 30.1);
    const Hit hit = caster.cast(ray);
    if (!std::isfinite(range)) {
      EXPECT_TRUE(hit.body == Hit::kNothing || hit.range > 99.f);
      continue;
    }
    ++met;
    EXPECT_EQ(hit.body, Hit::kGround);
    EXPECT_NEAR(hit.range, range, 1e-5 * range + 2e-6);
  }
  EXPECT_GT(met, 500);
}

INSTANTIATE_TEST_SUITE_P(CasterGround, NearAndFarGround, testing::Values(0.0, 1000.0));

TEST(CasterGround, WaterLeansAsItsHeightSays) {
  const World world = sea();
  Caster caster(world);
  caster.setWindow(7.0, 7.0);
  for (const Ray& ray : randomRays(100, 8, 0.0, 1.2)) {
    const Hit hit = caster.cast({ray.origin, {0, 0, -1}});
    const double x = ray.origin.x(), y = ray.origin.y(), e = 1e-4;
    const auto h = [&](double dx, double dy) { return world.ground.height(x + dx, y + dy, 7.0); };
    const Vector3d up(-(h(e, 0) - h(-e, 0)) / (2 * e), -(h(0, e) - h(0, -e)) / (2 * e), 1);
    EXPECT_TRUE(hit.normal.isApprox(up.normalized().cast<float>(), 1e-4f));
  }
}

TEST(CasterGround, CalmWaterIsAPlane) {
  World world;
  world.ground.kind = Ground::Kind::kWater;
  const Caster caster(world);
  EXPECT_FLOAT_EQ(caster.cast({{0, 0, 2}, {0.6f, 0, -0.8f}}).range, 2.5f);
  EXPECT_EQ(caster.cast({{0, 0, 2}, {1, 0, 0}}).body, Hit::kNothing);
  EXPECT_EQ(caster.cast({{0, 0, 2}, {0, 0, 1}}).body, Hit::kNothing);
}

TEST(CasterGround, WaterIsSeenFromBelowToo) {
  World world = sea();
  const Hit hit = Caster(world).cast({{0, 0, -5}, {0, 0, 1}});
  EXPECT_EQ(hit.body, Hit::kGround);
  EXPECT_NEAR(hit.range, 5 + world.ground.height(0, 0, 0), 1e-4);
  EXPECT_LT(hit.normal.z(), 0.f);
}

TEST(CasterGround, RoughGroundFollowsItsHeights) {
  World world;
  world.ground.kind = Ground::Kind::kRough;
  world.ground.roughness = 0.08, world.ground.half_extent = 30;
  const Caster caster(world);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-29, 29);
  for (int i = 0; i < 1000; ++i) {
    const double x = place(random), y = place(random);
    const Hit hit = caster.cast({Vector3d(x, y, 5).cast<float>(), {0, 0, -1}});
    EXPECT_EQ(hit.body, Hit::kGround);
    EXPECT_EQ(hit.material, &world.ground.material);
    EXPECT_NEAR(5 - hit.range, world.ground.height(x, y, 0), 0.004) << "a chord of an eighth of a grain";
    EXPECT_GT(hit.normal.z(), 0.5f);
  }
  EXPECT_EQ(caster.cast({{40, 0, 5}, {0, 0, -1}}).body, Hit::kNothing) << "beyond its extent";
}

TEST(CasterGround, BodyHidesTheGroundBehindIt) {
  World world = test::worldOf(test::boxMesh({1, 1, 1}));
  world.ground.kind = Ground::Kind::kPlane;
  const Caster caster(world);
  const Vector3f along = Vector3f(1, 0, -0.3f).normalized();
  EXPECT_EQ(caster.cast({{-3, 0, 1}, along}).body, 0);
  EXPECT_EQ(caster.cast({{0.6f, 0, 1}, along}).body, Hit::kGround);
}

}  // namespace
}  // namespace field_fusion::core::sim
