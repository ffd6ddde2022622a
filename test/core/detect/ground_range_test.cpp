#include "field_fusion/core/detect/ground_range.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion::core {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const Pinhole kCamera{600, 600, 320, 240};
constexpr double kHeight = 1.5;  // m, of the camera above the ground
const Plane kGround{-Vector3d::UnitY(), kHeight};
constexpr int kTrials = 20000;

/// The optical frame of a camera that looks down by `pitch`, seen from the level one.
Eigen::Matrix3d pitched(double pitch) { return AngleAxisd(pitch, Vector3d::UnitX()).toRotationMatrix(); }

/// Box of an upright body 1.7 m high and 0.5 m wide, `x` m to the right and `z` m ahead of a level camera's
/// foot, as a camera sees it that looks down by `pitch`.
ImageBox boxAt(double x, double z, double pitch = 0) {
  const auto pixel = [&](double dx, double y) {
    const Vector3d p = pitched(pitch) * Vector3d(x + dx, y, z);
    return cv::Point2d(kCamera.fx * p.x() / p.z() + kCamera.cx, kCamera.fy * p.y() / p.z() + kCamera.cy);
  };
  const cv::Point2d foot = pixel(0, kHeight), head = pixel(0, kHeight - 1.7);
  const double half_width = kCamera.fx * 0.25 / z;
  return {float(foot.x - half_width), float(head.y), float(foot.x + half_width), float(foot.y)};
}

MonoRange estimate(const ImageBox& box, std::uint8_t cut = 0, const Plane& ground = kGround) {
  return rangeFromGround(box, cut, 1.0, kCamera, ground, RangeParams{});
}

bool unknown(const MonoRange& r) { return std::isnan(r.depth) && std::isnan(r.range) && std::isnan(r.sigma); }

/// Mean and standard deviation of what `draw` gives.
template <class Draw>
std::pair<double, double> scatter(Draw&& draw) {
  double sum = 0, squares = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double value = draw();
    sum += value, squares += value * value;
  }
  const double mean = sum / kTrials;
  return {mean, std::sqrt(squares / kTrials - mean * mean)};
}

TEST(RangeFromGround, IsExactForALevelCamera) {
  for (const double x : {-3.0, 0.0, 4.0}) {
    const ImageBox box = boxAt(x, 8);
    const MonoRange r = estimate(box);
    const double y =
        8 * (box.centre().y - kCamera.cy) / kCamera.fy;  // of the box centre, upright above the foot
    EXPECT_NEAR(r.range, std::sqrt(x * x + y * y + 64), 2e-3);
    EXPECT_NEAR(r.depth, 8, 2e-3);
  }
}

TEST(RangeFromGround, IsExactForACameraThatLooksDown) {
  const double pitch = radians(25), distance = 6;
  const ImageBox box = boxAt(0, distance, pitch);
  const Plane ground{pitched(pitch) * kGround.normal, kHeight};
  const MonoRange r = estimate(box, 0, ground);
  const double below_axis = std::atan((box.centre().y - kCamera.cy) / kCamera.fy);
  EXPECT_NEAR(r.range, distance / std::cos(pitch + below_axis), 1e-3);
  EXPECT_NEAR(r.depth, r.range * std::cos(below_axis), 1e-3);
}

// Against the scatter of the estimate itself under the errors that the parameters state.
TEST(RangeFromGround, SigmaIsTheScatterOfTheEstimate) {
  RangeParams params;
  params.plane_tilt_sigma = 0.3;
  const double input_scale = 0.5;  // one pixel of the input is two of the image
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const double z : {4.0, 8.0, 14.0}) {
    const auto [mean, deviation] = scatter([&] {
      ImageBox box = boxAt(2, z);
      box.y_max += float(normal(random) * params.box_pixel_error / input_scale);
      const Vector3d turn = radians(params.plane_tilt_sigma) * Vector3d(normal(random), 0, normal(random));
      const Plane ground{(kGround.normal + turn.cross(kGround.normal)).normalized(),
                         kHeight + params.plane_height_sigma * normal(random)};
      return rangeFromGround(box, 0, input_scale, kCamera, ground, params).range;
    });
    const MonoRange r = rangeFromGround(boxAt(2, z), 0, input_scale, kCamera, kGround, params);
    EXPECT_NEAR(r.sigma / deviation, 1.0, 0.06) << "at " << z << " m";
  }
}

TEST(RangeFromGround, IsUnknownWhereTheBottomIsCut) {
  EXPECT_TRUE(unknown(estimate(boxAt(0, 8), kCutBottom)));
  EXPECT_FALSE(unknown(estimate(boxAt(0, 8), kCutTop | kCutLeft | kCutRight)));
}

TEST(RangeFromGround, IsUnknownAtAndAboveTheHorizon) {
  EXPECT_TRUE(unknown(estimate({300, 200, 340, 240})));
  EXPECT_TRUE(unknown(estimate({300, 100, 340, 200})));
}

TEST(RangeFromGround, IsUnknownWhereTheErrorsLeaveNothing) {
  EXPECT_TRUE(unknown(estimate({300, 200, 340, 241})));  // 900 m: one pixel is half of that
  EXPECT_TRUE(unknown(estimate(boxAt(0, 200))));
  EXPECT_FALSE(unknown(estimate(boxAt(0, 40))));
}

TEST(RangeFromGround, IsUnknownWithoutGroundCameraOrBox) {
  const ImageBox box = boxAt(0, 8);
  EXPECT_TRUE(unknown(estimate(box, 0, Plane{})));
  EXPECT_TRUE(unknown(estimate(box, 0, {kGround.normal, -1.0})));  // the camera below it
  EXPECT_TRUE(unknown(estimate(box, 0, {kGround.normal, 0.0})));
  EXPECT_TRUE(unknown(rangeFromGround(box, 0, 1.0, Pinhole{}, kGround, RangeParams{})));
  EXPECT_TRUE(unknown(estimate({300, 200, 340, kNaN})));
  EXPECT_TRUE(unknown(estimate({kNaN, 200, 340, 300})));
}

TEST(Combined, WeighsByInverseVariances) {
  const MonoRange r = combined({10, 10, 1, 0}, {12, 12, 2, 0});
  EXPECT_DOUBLE_EQ(r.range, 10.4);
  EXPECT_DOUBLE_EQ(r.depth, 10.4);
  EXPECT_DOUBLE_EQ(r.sigma, std::sqrt(0.8));
}

TEST(Combined, IsTheOtherWhereOneIsUnknown) {
  const MonoRange known{9, 10, 1, 0.5};
  for (const MonoRange& r : {combined(known, {}), combined({}, known)}) {
    EXPECT_EQ(r.range, 10);
    EXPECT_EQ(r.sigma, 1);
  }
  EXPECT_TRUE(unknown(combined({}, {})));
}

TEST(Combined, AdmitsThatEstimatesWhichDifferCannotBothBeRight) {
  const double agreeing = combined({10, 10, 1, 0}, {10, 10, 1, 0}).sigma;
  const double limit = std::sqrt(2.0);
  EXPECT_DOUBLE_EQ(combined({10, 10, 1, 0}, {10 + limit, 10 + limit, 1, 0}).sigma, agreeing);
  EXPECT_DOUBLE_EQ(combined({10, 10, 1, 0}, {20, 20, 1, 0}).sigma, agreeing * 10 / limit);
}

TEST(Combined, SigmaHoldsForEstimatesThatShareTheBottomEdge) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const MonoRange a{10, 10, std::hypot(0.5, 0.3), 0.5}, b{10, 10, std::hypot(0.8, 0.2), 0.8};
  const auto [mean, deviation] = scatter([&] {
    const double edge = normal(random);
    MonoRange x = a, y = b;
    x.range += 0.5 * edge + 0.3 * normal(random);
    y.range += 0.8 * edge + 0.2 * normal(random);
    return combined(x, y).range;
  });
  EXPECT_NEAR(mean, 10, 0.02);
  EXPECT_NEAR(combined(a, b).sigma / deviation, 1.0, 0.03);
}

}  // namespace
}  // namespace field_fusion::core
