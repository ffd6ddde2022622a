#include "field_fusion/core/match/outline.h"

#include <gtest/gtest.h>

#include <random>

#include "field_fusion/core/detect/image_box.h"
#include "support/bodies.h"

namespace field_fusion::core {
namespace {

using Eigen::Vector3d;

const Transform kCamera = test::lookingAhead({0.1, 0, -0.2});

/// The near half of an upright cylinder, a point for each degree and each row of heights.
std::vector<Point> cylinder(const Vector3d& foot, double radius, const std::vector<double>& heights) {
  std::vector<Point> out;
  const double sight = std::atan2(foot.y(), foot.x());
  for (const double z : heights)
    for (int degree = 95; degree <= 265; ++degree) {
      Point p;
      p.x = static_cast<float>(foot.x() + radius * std::cos(sight + radians(degree)));
      p.y = static_cast<float>(foot.y() + radius * std::sin(sight + radians(degree)));
      p.z = static_cast<float>(z);
      out.push_back(p);
    }
  return out;
}

OutlineFitter fitter() {
  ShapeParams shapes;
  shapes.class_diameters = {{"cage", 2.0}};
  shapes.class_nets.clear();
  shapes.class_lengths = {{"car", 4.4}};
  shapes.class_widths = {{"car", 1.8}};
  OutlineFitter out;
  out.setParams(shapes, 0.03);
  return out;
}

/// As the camera sees an upright cylinder from its own height over the upper and under the lower edge.
CameraTarget seen(double top, double bottom) {
  CameraTarget out;
  out.label = "cage";
  out.box = {0.1, -0.1, top, bottom};
  return out;
}

// 10 m away, 1 m in radius, from -1.3 to -0.3; the rows of the LiDAR meet it at -1.0 and -0.6 only. From the
// camera, 0.2 m lower than the LiDAR and 0.1 m ahead, its far upper and its near lower edge are seen.
TEST(Outline, HeightsAreTheCameras) {
  auto points = cylinder({10, 0, 0}, 1.0, {-1.0, -0.6});
  const auto target = seen(-0.1 / (9.9 + 1.0), -1.1 / (9.9 - 1.0));
  const auto outline = fitter().run(points, target, viewFromOptical() * kCamera.inverse());
  ASSERT_TRUE(outline);
  EXPECT_LT((outline->centre - Vector3d(10, 0, -0.8)).norm(), 0.03) << outline->centre.transpose();
  EXPECT_LT((outline->size - Vector3d(2, 2, 1)).norm(), 0.06) << outline->size.transpose();
  EXPECT_LT((outline->face - Vector3d(9, 0, -0.3)).norm(), 0.04) << outline->face.transpose();
}

TEST(Outline, AnEdgeCutByTheImageIsTheLidars) {
  auto points = cylinder({10, 0, 0}, 1.0, {-1.0, -0.6});
  auto target = seen(-0.1 / 10.9, -0.5 / 8.9);
  target.cut = kCutBottom;
  const auto outline = fitter().run(points, target, viewFromOptical() * kCamera.inverse());
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->centre.z(), 0.5 * (-1.0 - 0.3), 0.02);
}

TEST(Outline, WithoutABoxOrATransformHeightsAreTheLidars) {
  Transform unknown = Transform::Identity();
  unknown.translation().setConstant(kNaN);
  for (const bool box : {false, true}) {
    auto points = cylinder({10, 0, 0}, 1.0, {-1.0, -0.6});
    CameraTarget target = seen(-0.01, -0.1);
    if (!box) target.box = {};
    const auto outline =
        fitter().run(points, target, box ? unknown : Transform(viewFromOptical() * kCamera.inverse()));
    ASSERT_TRUE(outline);
    EXPECT_NEAR(outline->centre.z(), -0.8, 1e-5);
    EXPECT_NEAR(outline->size.z(), 0.4, 1e-5);
  }
}

TEST(Outline, ABodyAtTheLidarsHeightIsNearestThere) {
  auto points = cylinder({5, 0, 0}, 1.0, {-0.5, 0.5});
  CameraTarget target;
  target.label = "cage";
  const auto outline = fitter().run(points, target, Transform::Identity());
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->face.z(), 0.0, 1e-9);
  EXPECT_NEAR(outline->face.norm(), 4.0, 0.02);
}

// A mast over a float: returns from anywhere between the near side and the middle, as far as the few there are.
TEST(Outline, FewReturnsOfABodyThatIsNoCylinderLeaveItsDepthOpen) {
  const double radius = 1.0;
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> share(0.0, 1.0), height(-1.0, -0.4);
  for (const int count : {1, 2, 4, 8}) {
    int inside = 0;
    const int trials = 400;
    for (int i = 0; i < trials; ++i) {
      std::vector<Point> points(static_cast<std::size_t>(count));
      for (Point& p : points) {
        p.x = static_cast<float>(10.0 - radius + radius * share(draw));
        p.z = static_cast<float>(height(draw));
      }
      for (int copy = 0; copy < 9; ++copy)  // a row meets one part of the body, however many rays it has
        points.insert(points.end(), points.begin(), points.begin() + count);
      CameraTarget target;
      target.label = "cage";
      const auto outline = fitter().run(points, target, Transform::Identity());
      ASSERT_TRUE(outline);
      inside += std::abs(outline->centre.x() - 10.0) < 2.0 * std::sqrt(outline->covariance(0, 0));
    }
    EXPECT_GT(inside, 0.9 * trials) << count << " rows";
  }
}

TEST(Outline, TheFaceOfABoxIsWhatIsSeen) {
  std::vector<Point> points;
  for (int i = 0; i <= 18; ++i) points.push_back({10.f, -0.9f + 0.1f * static_cast<float>(i), -0.5f});
  CameraTarget target;
  target.label = "car";
  const auto outline = fitter().run(points, target, Transform::Identity());
  ASSERT_TRUE(outline);
  EXPECT_LT((outline->centre - Vector3d(12.2, 0, -0.5)).norm(), 0.02) << outline->centre.transpose();
  EXPECT_LT((outline->face - Vector3d(10, 0, -0.5)).norm(), 1e-5);
}

// a cage of 4 m where the user told of cages of 2 m: better as it is seen than cut to size
TEST(Outline, ARoundBodyLargerThanItsClassStaysAsItIsSeen) {
  CameraTarget target;
  target.label = "cage";
  auto large = cylinder({10, 0, 0}, 2.0, {0.0}), usual = cylinder({10, 0, 0}, 1.1, {0.0});
  EXPECT_FALSE(fitter().run(large, target, Transform::Identity()));
  EXPECT_TRUE(fitter().run(usual, target, Transform::Identity()));
}

TEST(Outline, WithoutSizeOrPointsThereIsNone) {
  CameraTarget target;
  target.label = "cow";
  auto points = cylinder({5, 0, 0}, 1.0, {0.0});
  EXPECT_FALSE(fitter().run(points, target, Transform::Identity()));
  target.label = "cage";
  points.clear();
  EXPECT_FALSE(fitter().run(points, target, Transform::Identity()));
}

TEST(NearestOf, OnePercentOfThePointsMayBeNearer) {
  std::vector<Point> points(200);
  for (std::size_t i = 0; i < 200; ++i) points[i].x = static_cast<float>(i + 1);
  EXPECT_EQ(nearestOf(points), Vector3d(3, 0, 0));
  points.resize(1);
  points[0] = {1.f, 2.f, 3.f};
  EXPECT_EQ(nearestOf(points), Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace field_fusion::core
