#include "field_fusion/core/sim/lidar3d.h"

#include <gtest/gtest.h>

#include "support/sim_worlds.h"

namespace field_fusion::core::sim {
namespace {

/// VLP-16 without its errors and with beams as thin as a ray.
Lidar3dParams perfect() {
  Lidar3dParams p;
  p.beam.spot_sampling = SpotSampling::kNever;
  p.fire_times = {2.304};
  p.beam.max_range = 150.0, p.beam.ten_percent_range = 1000.0;
  p.beam.energy_noise = p.beam.range_noise = p.beam.slant_noise = p.beam.range_bias = p.beam.range_step = 0.0;
  return p;
}

World wallOnGround() {
  World world = test::worldOf({test::wallAhead("wall", 8.f, -300.f, 300.f, test::matt(0.6f))});
  world.ground.kind = Ground::Kind::kPlane;
  world.ground.material = test::matt(0.2f);
  return world;
}

PoseAt mast(double height, double turn_rate = 0.0) {
  return [height, turn_rate](double time) {
    return Transform(Eigen::Translation3d(0, 0, height) *
                     Eigen::AngleAxisd(turn_rate * time, Eigen::Vector3d::UnitZ()));
  };
}

/// [m] along a unit direction from above the origin to the wall x = 8 or the ground z = 0; +inf for neither.
double trueRange(const Eigen::Vector3d& direction, double height) {
  const double endless = std::numeric_limits<double>::infinity();
  const double wall = direction.x() > 0.0 ? 8.0 / direction.x() : endless;
  const double ground = direction.z() < 0.0 ? -height / direction.z() : endless;
  return std::min(wall, ground);
}

TEST(Lidar3d, StandingMeasuresPlanesExactly) {
  const World world = wallOnGround();
  Caster caster(world);
  Lidar3d lidar(perfect(), 1);
  const Cloud& cloud = lidar.scan(caster, mast(2.0), 0.0);
  ASSERT_GT(cloud.size(), 15000u);
  for (const Point& p : cloud) {
    const Eigen::Vector3d at = p.position().cast<double>();
    const double expected = trueRange(at.normalized(), 2.0);
    if (expected > 100.0) continue;
    EXPECT_NEAR(at.norm(), expected, 1e-5 * expected);
  }
}

TEST(Lidar3d, FiresRingByRingWhileItTurns) {
  const World world = wallOnGround();
  Caster caster(world);
  const Lidar3dParams params = perfect();
  Lidar3d lidar(params, 1);
  EXPECT_EQ(params.columns(), 1808);
  std::vector<int> of_ring(16, 0);
  for (const Point& p : lidar.scan(caster, mast(2.0), 5.0)) {
    const Polar polar = core::polar(p.position().cast<double>());
    EXPECT_NEAR(degrees(polar.elevation), params.elevations[p.ring], 1e-4);
    const double turned = angleDifference(radians(180.0) - radians(3600.0) * p.time, polar.azimuth);
    EXPECT_NEAR(turned, 0.0, 1e-5);
    const double in_column = std::fmod(p.time * 1e6 - 2.304 * p.ring + 1.0, 55.296);
    EXPECT_NEAR(in_column, 1.0, 0.1);
    ++of_ring[p.ring];
  }
  for (int ring = 0; ring < 8; ++ring) EXPECT_EQ(of_ring[ring], 1808) << ring;  // the ground all around
  EXPECT_NEAR(of_ring[12], 904, 40);                                            // the wall alone
}

TEST(Lidar3d, TurningDistortsAsItsPointsTimesSay) {
  const World world = wallOnGround();
  Caster caster(world);
  Lidar3d lidar(perfect(), 1);
  const double rate = radians(90.0);
  for (const Point& p : lidar.scan(caster, mast(2.0, rate), 0.0)) {
    const Eigen::AngleAxisd turn(rate * p.time, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d direction = turn * p.position().cast<double>().normalized();
    const double expected = trueRange(direction, 2.0);
    if (expected > 60.0) continue;
    EXPECT_NEAR(p.position().norm(), expected, 2e-5 * expected);
  }
}

TEST(Lidar3d, TellsTheTruthOfEachPoint) {
  const World world = wallOnGround();
  Caster caster(world);
  Lidar3dParams params = perfect();
  params.beam.range_noise = 0.03;
  Lidar3d lidar(params, 1);
  const Cloud& cloud = lidar.scan(caster, mast(2.0), 0.0);
  ASSERT_EQ(lidar.truth().size(), cloud.size());
  std::vector<double> errors;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const BeamReturn& truth = lidar.truth()[i];
    EXPECT_FLOAT_EQ(truth.range, cloud[i].position().norm());
    EXPECT_TRUE(truth.body == 0 || truth.body == Hit::kGround);
    errors.push_back(truth.range - truth.true_range);
  }
  EXPECT_NEAR(test::spreadOf(errors).sigma, 0.03, 0.001);
}

TEST(Lidar3d, GivesEachRingABiasOfItsOwn) {
  const World world = wallOnGround();
  Caster caster(world);
  Lidar3dParams params = perfect();
  params.beam.range_bias = 0.02;
  Lidar3d lidar(params, 1);
  lidar.scan(caster, mast(2.0), 0.0);
  const Cloud& cloud = lidar.scan(caster, mast(2.0), 0.0);
  for (std::size_t i = 0; i < cloud.size(); i += 100)
    EXPECT_NEAR(lidar.truth()[i].range - lidar.truth()[i].true_range, lidar.noise().bias(cloud[i].ring),
                1e-4);
  EXPECT_NE(lidar.noise().bias(0), lidar.noise().bias(15));
}

TEST(Lidar3d, SeesNothingInAnEmptyWorld) {
  const World world = test::worldOf({});
  Caster caster(world);
  Lidar3d lidar(perfect(), 1);
  EXPECT_TRUE(lidar.scan(caster, mast(2.0), 0.0).empty());
}

TEST(Lidar3d, DoesNotDependOnThreadsButOnTheSeed) {
  const World world = wallOnGround();
  Caster caster(world);
  const auto positions = [&](std::uint64_t seed, int threads) {
    Lidar3dParams params;  // with errors
    params.beam.threads = threads;
    std::vector<float> out;
    Lidar3d lidar(params, seed);
    for (const Point& p : lidar.scan(caster, mast(2.0, 1.0), 0.0))
      out.insert(out.end(), {p.x, p.y, p.z, p.intensity, p.time});
    return out;
  };
  EXPECT_EQ(positions(1, 1), positions(1, 5));
  EXPECT_NE(positions(1, 1), positions(2, 1));
}

TEST(Lidar3d, RefusesParametersThatMakeNoLidar) {
  const auto refused = [](auto change) {
    Lidar3dParams p;
    change(p);
    EXPECT_THROW(Lidar3d(p, 1), std::invalid_argument);
  };
  refused([](auto& p) { p.rate = 0.0; });
  refused([](auto& p) { p.elevations = {}; });
  refused([](auto& p) { p.elevations = {1.0, 1.0}; });
  refused([](auto& p) { p.fire_times = {0.0, 1.0}; });  // of 16
  refused([](auto& p) { p.column_time = 100000.0, p.rate = 100.0; });
}

}  // namespace
}  // namespace field_fusion::core::sim
