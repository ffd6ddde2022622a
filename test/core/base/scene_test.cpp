#include "support/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "field_fusion/core/base/types.h"

namespace field_fusion::test {
namespace {

using core::cartesian;
using core::radians;

const Eigen::Vector3d kEye(0, 0, 2);

Body box(Eigen::Vector2d middle, Eigen::Vector3d size) { return {Body::Shape::kBox, size, middle}; }
Body cylinder(Eigen::Vector2d middle, double width, double height) {
  return {Body::Shape::kCylinder, {width, width, height}, middle};
}

Hit cast(const Scene& scene, const Eigen::Vector3d& direction) {
  return test::cast(scene, kEye, direction.normalized());
}

TEST(Cast, MeetsTheGroundOfAnEmptyScene) {
  const Hit hit = cast({}, cartesian({1.0, radians(40.0), radians(-30.0)}));
  EXPECT_NEAR(hit.range, 4.0, 1e-12);  // 2 m / sin 30 deg
  EXPECT_EQ(hit.body, Hit::kGround);
}

TEST(Cast, MeetsNothingAboveTheHorizon) {
  for (const double elevation : {0.0, 0.1, radians(90.0)}) {
    const Hit hit = cast({}, cartesian({1.0, 0.0, elevation}));
    EXPECT_EQ(hit.body, Hit::kNothing);
    EXPECT_TRUE(std::isinf(hit.range));
  }
}

TEST(Cast, MeetsTheNearFaceOfABox) {
  const Scene scene{box({10, 0}, {2, 4, 3})};
  EXPECT_DOUBLE_EQ(cast(scene, {1, 0, 0}).range, 9.0);
  EXPECT_NEAR(cast(scene, {9, 1.5, 0}).range, std::hypot(9.0, 1.5), 1e-12);
  EXPECT_EQ(cast(scene, {1, 0, 0}).body, 0);
}

TEST(Cast, PassesABoxOnEverySide) {
  const Scene scene{box({10, 0}, {2, 4, 3})};
  EXPECT_EQ(cast(scene, {9, 2.1 * 11 / 9, 0}).body, Hit::kNothing);
  EXPECT_EQ(cast(scene, {9, 0, 1.1 * 11 / 9}).body, Hit::kNothing);
  EXPECT_EQ(cast(scene, {-1, 0, 0}).body, Hit::kNothing);
}

TEST(Cast, MeetsTheRoof) {
  EXPECT_DOUBLE_EQ(test::cast({box({0, 0}, {2, 2, 1})}, kEye, {0, 0, -1}).range, 1.0);
  EXPECT_DOUBLE_EQ(test::cast({cylinder({0, 0}, 2, 1)}, kEye, {0, 0, -1}).range, 1.0);
  // 45 deg down: on the roof's plane, 1 m below the eye, after 1 m over ground
  EXPECT_NEAR(cast({cylinder({1.5, 0}, 2, 1)}, {1, 0, -1}).range, std::sqrt(2.0), 1e-12);
}

TEST(Cast, MeetsTheMantleOfACylinder) {
  const Scene scene{cylinder({10, 0}, 2, 3)};
  EXPECT_NEAR(cast(scene, {1, 0, 0}).range, 9.0, 1e-12);
  const double grazing = std::asin(1.0 / 10.0);  // half the angle under which it appears
  EXPECT_NEAR(cast(scene, cartesian({1, grazing * 0.999999, 0})).range, std::sqrt(99.0), 0.02);
  EXPECT_EQ(cast(scene, cartesian({1, grazing * 1.000001, 0})).body, Hit::kNothing);
}

TEST(Cast, DoesNotSeeTheBodyThatHoldsTheOrigin) {
  EXPECT_EQ(cast({box({0, 0}, {2, 2, 5})}, {1, 0, 0}).body, Hit::kNothing);
  EXPECT_EQ(cast({cylinder({0, 0}, 2, 5)}, {1, 0, 0}).body, Hit::kNothing);
}

TEST(Cast, TakesTheNearestInWhateverOrder) {
  const Scene scene{box({20, 0}, {2, 2, 3}), box({10, 0}, {2, 2, 3})};
  EXPECT_EQ(cast(scene, {1, 0, 0}).body, 1);
  EXPECT_EQ(cast({scene[1], scene[0]}, {1, 0, 0}).body, 0);
}

/// Walks along the ray in small steps until a point lies in a body.
double walk(const Scene& scene, const Eigen::Vector3d& direction, double step) {
  for (double range = 0.0; range < 30.0; range += step) {
    const Eigen::Vector3d p = kEye + range * direction;
    for (const Body& body : scene) {
      const Eigen::AlignedBox3d bounds = body.box();
      const bool round = body.shape == Body::Shape::kCylinder;
      if (round && (p - bounds.center()).head<2>().norm() > 0.5 * body.size.x()) continue;
      if (bounds.contains(p)) return range;
    }
    if (p.z() < 0.0) return range;
  }
  return INFINITY;
}

TEST(Cast, EqualsAWalkAlongTheRay) {
  const Scene scene{box({8, 1}, {3, 2, 1.5}), cylinder({5, -2}, 1, 3), cylinder({-4, 0}, 2, 1),
                    box({-6, 5}, {1, 1, 4})};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> azimuth(-3.14, 3.14), elevation(-1.2, 0.3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d ray = cartesian({1.0, azimuth(random), elevation(random)});
    const double range = test::cast(scene, kEye, ray).range, walked = walk(scene, ray, 0.005);
    if (std::isinf(walked)) {
      EXPECT_GT(range, 29.9);
    } else {
      EXPECT_NEAR(range, walked, 0.0051) << ray.transpose();
    }
  }
}

}  // namespace
}  // namespace field_fusion::test
