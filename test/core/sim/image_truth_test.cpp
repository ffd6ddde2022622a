#include "field_fusion/core/sim/image_truth.h"

#include <gtest/gtest.h>

#include "camera_world.h"

namespace field_fusion::core::sim {
namespace {

using test::bodyOf;
using test::boxMesh;
using test::lookFrom;
using test::plainCamera;
using test::shoot;
using test::still;
using test::worldOf;

World labelled(Shape shape, const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  World world = worldOf(std::move(shape), still(at));
  world.bodies[0].label = "thing";
  return world;
}

/// A point of the world that the camera at the origin sees, in outer-corner pixels.
Eigen::Vector2d pixelOf(const CameraParams& p, const Eigen::Vector3d& world) {
  return Lens(p).project({-world.y(), -world.z(), world.x()}) + Eigen::Vector2d(0.5, 0.5);
}

void expectBox(const ImageBox& box, double x_min, double y_min, double x_max, double y_max) {
  EXPECT_NEAR(box.x_min, x_min, 1.0);
  EXPECT_NEAR(box.y_min, y_min, 1.0);
  EXPECT_NEAR(box.x_max, x_max, 1.0);
  EXPECT_NEAR(box.y_max, y_max, 1.0);
}

TEST(ImageTruth, BoxOfASphereAheadIsItsTangentCone) {
  const CameraParams p = plainCamera();
  const ColourFrame frame = shoot(labelled(Sphere{{10, 0, 0}, 1.f}), p, Transform::Identity());
  const double r = 500.0 * std::tan(std::asin(0.1));
  ASSERT_EQ(frame.views.size(), 1u);
  expectBox(frame.views[0].box, 320 - r, 240 - r, 320 + r, 240 + r);
  expectBox(frame.views[0].visible_box, 320 - r, 240 - r, 320 + r, 240 + r);
  EXPECT_EQ(frame.views[0].visible, 1.0);
  EXPECT_EQ(frame.views[0].cut, 0);
}

TEST(ImageTruth, BoxOfASphereAsideThroughADistortingLens) {
  CameraParams p = plainCamera();
  p.k1 = -0.2, p.k2 = 0.05;
  const ColourFrame frame = shoot(labelled(Sphere{{10, 3, 0}, 1.f}), p, Transform::Identity());
  // the tangent rays in the plane of axis and centre, and the middle of the sphere's row
  const double azimuth = std::atan2(3.0, 10.0), half = std::asin(1.0 / std::hypot(10.0, 3.0));
  const auto column = [&](double a) { return pixelOf(p, {std::cos(a), std::sin(a), 0.0}).x(); };
  ASSERT_EQ(frame.views.size(), 1u);
  EXPECT_NEAR(frame.views[0].box.x_min, column(azimuth + half), 1.0);
  EXPECT_NEAR(frame.views[0].box.x_max, column(azimuth - half), 1.0);
  EXPECT_NEAR(frame.views[0].box.centre().y, 240.0, 1.0);
}

TEST(ImageTruth, BoxOfABoxIsThatOfItsCorners) {
  const CameraParams p = plainCamera();
  const ColourFrame frame = shoot(labelled(boxMesh({2, 1, 1.5f}), {8, 1, -1}), p, Transform::Identity());
  ASSERT_EQ(frame.views.size(), 1u);
  const Eigen::Vector2d low = pixelOf(p, {7, 1.5, 0.5}), high = pixelOf(p, {7, 0.5, -1});
  // the right face is seen too: its far edge lies farther to the right only if it is left of the axis
  expectBox(frame.views[0].box, low.x(), low.y(), pixelOf(p, {9, 0.5, -1}).x(), high.y());
}

TEST(ImageTruth, HalfCoveredPlaneIsHalfVisible) {
  World world = labelled(boxMesh({0.1f, 4, 2}), {10, 0, -1});
  // a wall at half the distance hides all left of the axis
  world.bodies.push_back(bodyOf(boxMesh({0.01f, 10, 10}), still({5, 5, -5})));
  const ColourFrame frame = shoot(world, plainCamera(), Transform::Identity());
  ASSERT_EQ(frame.views.size(), 1u);
  EXPECT_NEAR(frame.views[0].visible, 0.5, 0.5 / (400.0 / 9.95));
  EXPECT_NEAR(frame.views[0].visible_box.x_min, 320.0, 1.0);
  EXPECT_LT(frame.views[0].box.x_min, 222.0);
}

TEST(ImageTruth, HiddenBodyIsThereAndInvisible) {
  World world = labelled(Sphere{{10, 0, 0}, 0.5f});
  world.bodies.push_back(bodyOf(boxMesh({0.1f, 4, 4}), still({5, 0, -2})));
  const ColourFrame frame = shoot(world, plainCamera(), Transform::Identity());
  ASSERT_EQ(frame.views.size(), 1u);
  EXPECT_EQ(frame.views[0].visible, 0.0);
  EXPECT_EQ(frame.views[0].visible_box.width(), 0.f);
  EXPECT_NEAR(frame.views[0].box.width(), 50.0, 2.0);
}

TEST(ImageTruth, BodyAtTheBorderIsCutThere) {
  const ColourFrame left = shoot(labelled(Sphere{{10, 6.4f, 0}, 1.f}), plainCamera(), Transform::Identity());
  ASSERT_EQ(left.views.size(), 1u);
  EXPECT_EQ(left.views[0].cut, kCutLeft);
  EXPECT_EQ(left.views[0].box.x_min, 0.f);
  const ColourFrame high = shoot(labelled(Sphere{{10, 0, 4.8f}, 1.f}), plainCamera(), Transform::Identity());
  ASSERT_EQ(high.views.size(), 1u);
  EXPECT_EQ(high.views[0].cut, kCutTop);
}

TEST(ImageTruth, BodyThatReachesBehindTheCameraIsSeen) {
  const ColourFrame frame =
      shoot(labelled(boxMesh({40, 1, 0.2f}), {0, 0, -1}), plainCamera(), Transform::Identity());
  ASSERT_EQ(frame.views.size(), 1u);
  EXPECT_EQ(frame.views[0].cut, kCutBottom);
  EXPECT_NEAR(frame.views[0].box.y_min, pixelOf(plainCamera(), {20, 0, -0.8}).y(), 1.0);
}

TEST(ImageTruth, WithoutALabelOrOutOfSightNothingIsTold) {
  World world = worldOf(Sphere{{10, 0, 0}, 1.f});
  EXPECT_TRUE(shoot(world, plainCamera(), Transform::Identity()).views.empty());
  world.bodies[0].label = "thing";
  EXPECT_TRUE(shoot(world, plainCamera(), lookFrom({0, 0, 0}, 3.0)).views.empty());
  EXPECT_TRUE(shoot(World{}, plainCamera(), lookFrom({0, 0, 1})).views.empty());
}

TEST(ImageTruth, RangeToABodyAloneIsThatOfTheBodyWithNothingBefore) {
  World world = worldOf(Sphere{{10, 0, 0}, 1.f});
  world.bodies.push_back(bodyOf(Sphere{{20, 0, 0}, 1.f}));
  const Caster caster(world);
  const Ray ray{{0, 0, 0}, {1, 0, 0}, 0.f};
  EXPECT_NEAR(caster.rangeTo(0, ray), 9.f, 1e-4f);
  EXPECT_NEAR(caster.rangeTo(1, ray), 19.f, 1e-4f);
  EXPECT_FALSE(std::isfinite(caster.rangeTo(1, {{0, 0, 0}, {0, 1, 0}, 0.f})));
  EXPECT_FALSE(std::isfinite(caster.rangeTo(Hit::kRobot, ray)));
}

}  // namespace
}  // namespace field_fusion::core::sim
