#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/shapes.h"
#include "test_world.h"

namespace field_fusion::core::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// One of each shape on a lattice, people walking.
World crowd() {
  World world;
  int i = 0;
  for (const auto& entry : shapeKinds()) {
    Body body = test::bodyOf(Sphere{{0, 0, 0}, 1});
    body.model =
        makeShape(entry.first, entry.first == "person" ? ShapeParams{{"speed", 1.3}} : ShapeParams{});
    body.way = test::still({-30.0 + 10.0 * (i % 7), -30.0 + 10.0 * (i / 7), 0.0}, 0.3 * i);
    world.bodies.push_back(body), ++i;
  }
  return world;
}

std::vector<Ray> fan(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1.f, 1.f);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vector3f from(35.f * unit(random), 35.f * unit(random), 1.5f + unit(random));
    const Vector3f along(unit(random), unit(random), 0.3f * unit(random));
    rays.push_back({from, along.normalized(), 0.5f + 0.5f * unit(random)});
  }
  return rays;
}

std::vector<Hit> castAll(const Caster& caster, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  caster.cast(rays.data(), hits.data(), rays.size());
  return hits;
}

bool same(const Hit& a, const Hit& b) {
  return a.range == b.range && a.body == b.body && a.normal == b.normal && a.place == b.place &&
         a.material == b.material;
}

TEST(CasterPacket, EqualsSingleRays) {
  const World world = crowd();
  Caster caster(world);
  caster.setWindow(1.0, 1.1);
  const std::vector<Ray> rays = fan(20003, 5);  // not a multiple of eight
  const std::vector<Hit> hits = castAll(caster, rays);
  std::size_t on_bodies = 0, different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    on_bodies += hits[i].body >= 0;
    different += !same(caster.cast(rays[i]), hits[i]);
  }
  EXPECT_GT(on_bodies, 1500u);
  EXPECT_LE(different, 4u) << "only a ray along an edge may choose the other face";
}

TEST(CasterPacket, ThreadsHaveNoSay) {
  const World world = crowd();
  const Caster caster(world);
  const std::vector<Ray> rays = fan(8000, 9);
  const std::vector<Hit> alone = castAll(caster, rays);
  std::vector<std::vector<Hit>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = castAll(caster, rays); });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results)
    for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(same(alone[i], result[i])) << i;
}

TEST(CasterPacket, AnotherCasterSeesTheSame) {
  const World world = crowd();
  const Caster a(world), b(world);
  const std::vector<Ray> rays = fan(8000, 11);
  const std::vector<Hit> hits_a = castAll(a, rays), hits_b = castAll(b, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(same(hits_a[i], hits_b[i])) << i;
}

TEST(CasterPacket, BlockedWhereSomethingIsHit) {
  const World world = crowd();
  const Caster caster(world);
  const std::vector<Ray> rays = fan(5000, 13);
  const std::vector<Hit> hits = castAll(caster, rays);
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool hit = std::isfinite(hits[i].range);
    different += caster.blocked(rays[i], hit ? 1.001f * hits[i].range : 1e4f) != hit;
    different += hit && caster.blocked(rays[i], 0.999f * hits[i].range);
  }
  EXPECT_LE(different, 4u);
}

class Sheer : public testing::TestWithParam<float> {};

/// The share of rays that pass is the material's, for each kind of surface; the same in packets and alone.
TEST_P(Sheer, SharePassesAsStated) {
  for (const Shape& shape : {Shape(test::boxMesh({20, 0.1f, 20})), Shape(Sphere{{0, 0, 5}, 5}),
                             Shape(Cylinder{{-10, 0, 5}, {20, 0, 0}, 5})}) {
    World world = test::worldOf(shape);
    world.bodies[0].model.links[0].parts[0].material.transparency = GetParam();
    const Caster caster(world);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1.f, 1.f);
    std::vector<Ray> rays;
    for (int i = 0; i < 20000; ++i)
      rays.push_back({{3 * unit(random), -20, 5 + 3 * unit(random)}, {0, 1, 0}});
    const std::vector<Hit> hits = castAll(caster, rays);
    double met = 0, blocked = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      met += hits[i].body == 0;
      blocked += caster.blocked(rays[i], 100.f);
      EXPECT_EQ(caster.cast(rays[i]).range, hits[i].range);
    }
    // a box is met on its front or its back face; for solids both are one surface
    const double p = GetParam(), expected = shape.index() == 0 ? 1 - p * p : 1 - p;
    EXPECT_NEAR(met / 20000, expected, 4 * std::sqrt(p * (1 - p) / 20000)) << shape.index();
    EXPECT_NEAR(blocked, met, 1) << shape.index();
  }
}

INSTANTIATE_TEST_SUITE_P(CasterPacket, Sheer, testing::Values(0.f, 0.3f, 0.75f, 1.f));

}  // namespace
}  // namespace field_fusion::core::sim
