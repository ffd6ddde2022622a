#include "field_fusion/core/sim/gnss.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

const Transform kAntenna(Eigen::Translation3d(0, 0, 2));

TEST(SimGnss, ErrorsHaveTheirDeviationsAndMemory) {
  GnssParams params;
  params.noise = 0.5;
  params.wander = 1.0;
  params.wander_time = 10.0;
  double squares = 0.0, after = 0.0, long_after = 0.0;
  constexpr int kSeeds = 1500;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Gnss gnss(params, Trajectory(), kAntenna, static_cast<std::uint64_t>(seed));
    double first = 0.0;
    for (int i = 0; i <= 300; ++i) {
      const double east = gnss.next().position.x();
      if (i == 0) first = east, squares += east * east;
      if (i == 50) after += first * east;        // 10 s
      if (i == 300) long_after += first * east;  // 60 s
    }
  }
  EXPECT_NEAR(squares / kSeeds, 0.25 + 1.0, 0.15);
  EXPECT_NEAR(after / kSeeds, std::exp(-1.0), 0.1);
  EXPECT_NEAR(long_after / kSeeds, 0.0, 0.1);
}

TEST(SimGnss, WithoutErrorsItIsTheAntennasPlace) {
  GnssParams params;
  params.noise = params.wander = 0.0;
  Gnss gnss(params, Trajectory({{{4, 5, 0}, 0.0, 0.0}}, {}), kAntenna, 1);
  gnss.next();
  const GnssSample sample = gnss.next();
  EXPECT_NEAR(sample.time, 0.2, 1e-12);
  EXPECT_EQ(sample.position, Eigen::Vector3d(4, 5, 2));
}

TEST(SimGnss, IsItsSeedsAndRefusesARateOfZero) {
  Gnss a({}, Trajectory(), kAntenna, 1), b({}, Trajectory(), kAntenna, 1), c({}, Trajectory(), kAntenna, 2);
  const Eigen::Vector3d first = a.next().position;
  EXPECT_EQ(first, b.next().position);
  EXPECT_NE(first, c.next().position);
  GnssParams params;
  params.rate = 0.0;
  EXPECT_THROW(Gnss(params, Trajectory(), kAntenna, 1), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
