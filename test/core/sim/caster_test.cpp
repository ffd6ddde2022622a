#include "field_fusion/core/sim/caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "test_world.h"

namespace field_fusion::core::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::boxMesh;
using test::still;
using test::worldOf;

constexpr float kRelative = 1e-5f;

/// Rays towards random places within `spread` of `target`, from random places about 10 m around it.
std::vector<Ray> raysTowards(const Vector3d& target, double spread, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto anywhere = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  std::vector<Ray> rays;
  while (rays.size() < 2000) {
    const Vector3f from = (target + 10.0 * anywhere().normalized()).cast<float>();
    const Vector3f to = (target + spread * anywhere()).cast<float>();
    rays.push_back({from, (to - from).normalized(), 0.f});
  }
  return rays;
}

/// Compares with what the formula says: `expected(origin, direction)` [m] or infinite.
template <class Expected>
void expectRanges(const World& world, const Vector3d& target, double spread, Expected&& expected) {
  const Caster caster(world);
  std::size_t same = 0, met = 0;
  for (const Ray& ray : raysTowards(target, spread, 7)) {
    const double range = expected(ray.origin.cast<double>(), ray.direction.cast<double>());
    const Hit hit = caster.cast(ray);
    if (std::isfinite(range) != std::isfinite(hit.range)) continue;  // at the rim; counted below
    ++same;
    if (!std::isfinite(range)) continue;
    ++met;
    EXPECT_NEAR(hit.range, range, kRelative * range);
    EXPECT_EQ(hit.body, 0);
    EXPECT_LE(hit.normal.dot(ray.direction), 0.f);
    EXPECT_NEAR(hit.normal.norm(), 1.f, 1e-5f);
  }
  EXPECT_GE(same, 1998u);
  EXPECT_GE(met, 200u);
}

double sphereRange(const Vector3d& o, const Vector3d& d, const Vector3d& centre, double radius) {
  const Vector3d from = o - centre;
  const double b = from.dot(d), square = b * b - d.squaredNorm() * (from.squaredNorm() - radius * radius);
  return square < 0.0 ? INFINITY : (-b - std::sqrt(square)) / d.squaredNorm();
}

/// Upright, standing at `foot`; only the first surface from outside.
double cylinderRange(const Vector3d& o, const Vector3d& d, const Vector3d& foot, double height,
                     double radius) {
  double best = INFINITY;
  const double end = d.z() < 0.0 ? foot.z() + height : foot.z(), cap = (end - o.z()) / d.z();
  if (cap > 0.0 && (o + cap * d - foot).head<2>().norm() <= radius) best = cap;
  Vector3d from = o - foot, flat = d;
  from.z() = flat.z() = 0.0;
  const double side = sphereRange(from, flat, Vector3d::Zero(), radius), z = o.z() + side * d.z();
  return z >= foot.z() && z <= foot.z() + height ? std::min(best, side) : best;
}

double boxRange(const Vector3d& o, const Vector3d& d, const Vector3d& low, const Vector3d& high) {
  const Eigen::Array3d a = (low - o).array() / d.array(), b = (high - o).array() / d.array();
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter <= leave && enter > 0.0 ? enter : INFINITY;
}

class NearAndFar : public testing::TestWithParam<double> {
 protected:
  const Vector3d at_{GetParam(), -GetParam(), 0.0};
};

TEST_P(NearAndFar, SphereIsWhereTheFormulaSays) {
  const World world = worldOf(Sphere{{0, 0, 0.3f}, 0.7f}, still(at_));
  expectRanges(world, at_, 1.0, [&](const Vector3d& o, const Vector3d& d) {
    return sphereRange(o, d, at_ + Vector3d(0, 0, 0.3f), 0.7f);
  });
}

TEST_P(NearAndFar, CylinderIsWhereTheFormulaSays) {
  const World world = worldOf(Cylinder{{0, 0, 0}, {0, 0, 1.5f}, 0.4f}, still(at_));
  expectRanges(world, at_, 1.0,
               [&](const Vector3d& o, const Vector3d& d) { return cylinderRange(o, d, at_, 1.5, 0.4f); });
}

TEST_P(NearAndFar, BoxIsWhereTheFormulaSays) {
  const World world = worldOf(boxMesh({1, 2, 3}), still(at_));
  const Vector3d half(0.5, 1.0, 0.0);
  expectRanges(world, at_, 2.0, [&](const Vector3d& o, const Vector3d& d) {
    return boxRange(o, d, at_ - half, at_ + half + Vector3d(0, 0, 3));
  });
}

TEST_P(NearAndFar, TurnedBoxIsWhereTheFormulaSays) {
  World world = worldOf(boxMesh({1, 2, 3}), still(at_, 0.7));
  const Transform T = world.bodies[0].way.pose(0.0).inverse();
  const Vector3d half(0.5, 1.0, 0.0);
  expectRanges(world, at_, 2.0, [&](const Vector3d& o, const Vector3d& d) {
    return boxRange(T * o, T.linear() * d, -half, half + Vector3d(0, 0, 3));
  });
}

INSTANTIATE_TEST_SUITE_P(Caster, NearAndFar, testing::Values(0.0, 1000.0));

TEST(Caster, RayAlongTheAxisMeetsTheEndOfACylinder) {
  const World world = worldOf(Cylinder{{0, 0, 0}, {0, 0, 2}, 0.5f});
  const Caster caster(world);
  EXPECT_FLOAT_EQ(caster.cast({{0.2f, 0, 5}, {0, 0, -1}}).range, 3.f);
  EXPECT_EQ(caster.cast({{0.2f, 0, 5}, {0, 0, -1}}).normal, Vector3f(0, 0, 1));
  EXPECT_EQ(caster.cast({{0.6f, 0, 5}, {0, 0, -1}}).body, Hit::kNothing);
  EXPECT_FLOAT_EQ(caster.cast({{0, 0, 1}, {1, 0, 0}}).range, 0.5f) << "from inside";
}

TEST(Caster, PlaceIsInTheFrameOfTheLink) {
  const World world = worldOf(boxMesh({2, 2, 2}), still({10, 5, 1}, radians(90.0)));
  const Hit hit = Caster(world).cast({{0, 5.5f, 1.5f}, {1, 0, 0}});
  EXPECT_FLOAT_EQ(hit.range, 9.f);
  EXPECT_TRUE(hit.place.isApprox(Vector3f(0.5f, 1.f, 0.5f), 1e-5f)) << hit.place.transpose();
  EXPECT_TRUE(hit.normal.isApprox(Vector3f(-1, 0, 0), 1e-6f)) << hit.normal.transpose();
  EXPECT_EQ(hit.material, &world.bodies[0].model.links[0].parts[0].material);
}

TEST(Caster, EmptyWorldIsEmpty) {
  World world;
  world.ground.kind = Ground::Kind::kNone;
  const Caster caster(world);
  const Hit hit = caster.cast({{0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(hit.body, Hit::kNothing);
  EXPECT_EQ(hit.material, nullptr);
  EXPECT_TRUE(std::isinf(hit.range));
  EXPECT_FALSE(caster.blocked({{0, 0, 1}, {0, 0, -1}}, 1e6f));
}

TEST(Caster, RayThatIsNoneHitsNothing) {
  const World world = worldOf(Sphere{{0, 0, 0}, 1.f});
  const Caster caster(world);
  const std::vector<Ray> rays = {{{NAN, 0, 0}, {1, 0, 0}},
                                 {{0, 0, 0}, {INFINITY, 0, 0}},
                                 {{0, 0, 0}, {0, 0, 0}},
                                 {{0, 0, 0}, {1, 0, 0}, 1.5f},
                                 {{-5, 0, 0}, {1, 0, 0}}};
  std::vector<Hit> hits(rays.size());
  caster.cast(rays.data(), hits.data(), rays.size());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(hits[i].body, Hit::kNothing) << i;
    EXPECT_EQ(caster.cast(rays[i]).body, Hit::kNothing) << i;
    EXPECT_FALSE(caster.blocked(rays[i], 10.f)) << i;
  }
  EXPECT_FLOAT_EQ(hits[4].range, 4.f);
}

TEST(Caster, BlockedUpToTheSurfaceOnly) {
  World world = worldOf(boxMesh({2, 2, 2}), still({6, 0, 0}));
  world.ground.kind = Ground::Kind::kPlane;
  const Caster caster(world);
  const Ray ray{{0, 0, 1}, {1, 0, 0}};
  EXPECT_FALSE(caster.blocked(ray, 4.99f));
  EXPECT_TRUE(caster.blocked(ray, 5.01f));
  EXPECT_FALSE(caster.blocked({{0, 0, 1}, {0, 1, 0}}, 100.f));
  EXPECT_TRUE(caster.blocked({{0, 0, 1}, {0, 0, -1}}, 2.f)) << "by the ground";
  EXPECT_FALSE(caster.blocked(ray, 0.f));
  EXPECT_FALSE(caster.blocked(ray, NAN));
}

TEST(Caster, RobotSeesItself) {
  World world;
  world.robot.model.links.push_back({{{Shape(Cylinder{{0, 0, 0}, {0, 0, 2}, 0.1f}), {}}}, {}, -1});
  world.robot.way = still({3, 0, 0});
  EXPECT_EQ(Caster(world).cast({{0, 0, 1}, {1, 0, 0}}).body, Hit::kRobot);
}

TEST(Caster, NearestOfManyBodiesIsSeen) {
  World world;
  for (int i = 0; i < 50; ++i)
    world.bodies.push_back(
        test::bodyOf(Sphere{{0, 0, 1}, 0.4f}, still({static_cast<double>(2 + (i * 7) % 50), 0, 0})));
  const Caster caster(world);
  for (int i = 0; i < 50; ++i) {
    const float x = 1.5f + static_cast<float>((i * 7) % 50);
    EXPECT_EQ(caster.cast({{x, 0, 1}, {1, 0, 0}}).body, i);
  }
}

struct Faulty {
  Shape shape;
  const char* says;
};

class FaultyShape : public testing::TestWithParam<Faulty> {};

TEST_P(FaultyShape, IsRefusedWithTheBodysName) {
  const World world = worldOf(GetParam().shape);
  try {
    const Caster caster(world);
    FAIL() << "no fault";
  } catch (const std::invalid_argument& fault) {
    EXPECT_NE(std::string(fault.what()).find("body thing: "), std::string::npos) << fault.what();
    EXPECT_NE(std::string(fault.what()).find(GetParam().says), std::string::npos) << fault.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Caster, FaultyShape,
    testing::Values(Faulty{Sphere{{0, 0, 0}, 0.f}, "sphere"}, Faulty{Sphere{{NAN, 0, 0}, 1.f}, "sphere"},
                    Faulty{Cylinder{{0, 0, 0}, {0, 0, 0}, 1.f}, "length"},
                    Faulty{Cylinder{{0, 0, 0}, {0, 0, 1}, -1.f}, "radius"}, Faulty{Mesh{}, "no triangles"},
                    Faulty{Mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}}, "not there"},
                    Faulty{Mesh{{{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}}}, "not finite"}));

}  // namespace
}  // namespace field_fusion::core::sim
