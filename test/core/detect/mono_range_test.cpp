#include "field_fusion/core/detect/mono_range.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion::core {
namespace {

const Pinhole kCamera{600, 600, 320, 240};

/// Box of an upright rectangle of 0.5 m x `height`, its middle at (x, y, z) in the optical frame.
ImageBox project(double x, double y, double z, double height) {
  const auto u = [&](double px) { return float(kCamera.fx * px / z + kCamera.cx); };
  const auto v = [&](double py) { return float(kCamera.fy * py / z + kCamera.cy); };
  return {u(x - 0.25), v(y - height / 2), u(x + 0.25), v(y + height / 2)};
}

MonoRange estimate(const ImageBox& box, std::uint8_t cut = 0, const std::string& label = "person") {
  return rangeFromHeight(label, box, cut, 1.0, kCamera, RangeParams{});
}

bool unknown(const MonoRange& r) { return std::isnan(r.depth) && std::isnan(r.range) && std::isnan(r.sigma); }

TEST(RangeFromHeight, IsExactForAnUprightBodyAnywhereInTheImage) {
  for (const double x : {-4.0, 0.0, 5.77})
    for (const double y : {-1.0, 0.0, 1.5}) {
      const MonoRange r = estimate(project(x, y, 10, 1.7));
      EXPECT_NEAR(r.depth, 10, 1e-3);
      EXPECT_NEAR(r.range, std::sqrt(x * x + y * y + 100), 1e-3);
    }
}

TEST(RangeFromHeight, TellsDepthFromRangeAtThirtyDegrees) {
  const MonoRange r = estimate(project(10 * std::tan(radians(30)), 0, 10, 1.7));
  EXPECT_NEAR(r.range / r.depth, 1 / std::cos(radians(30)), 1e-4);
}

// Against the scatter of the estimate itself under the errors that the parameters state.
TEST(RangeFromHeight, SigmaIsTheScatterOfTheEstimate) {
  RangeParams params;
  params.box_pixel_error = 1.0;
  params.height_spread = 0.05;
  const double input_scale = 0.5;  // one pixel of the input is two of the image
  std::mt19937 random(5);
  std::normal_distribution<double> edge(0, 2.0), spread(0, 0.05);
  for (const double z : {5.0, 15.0, 25.0}) {
    double sum = 0, squares = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      ImageBox box = project(3, 0.5, z, 1.7 * (1 + spread(random)));
      for (float* side : {&box.x_min, &box.y_min, &box.x_max, &box.y_max}) *side += float(edge(random));
      const double range = rangeFromHeight("person", box, 0, input_scale, kCamera, params).range;
      sum += range;
      squares += range * range;
    }
    const double scatter = std::sqrt(squares / n - sum / n * (sum / n));
    const MonoRange r = rangeFromHeight("person", project(3, 0.5, z, 1.7), 0, input_scale, kCamera, params);
    EXPECT_NEAR(r.sigma / scatter, 1.0, 0.05) << "at " << z << " m";
  }
}

TEST(RangeFromHeight, TakesTheSpreadOfTheClass) {
  RangeParams params;
  params.box_pixel_error = 1e-6;
  params.class_height_spreads = {{"boat", 0.5}};
  const MonoRange boat = rangeFromHeight("boat", {300, 200, 340, 280}, 0, 1, kCamera, params);
  const MonoRange person = rangeFromHeight("person", {300, 200, 340, 280}, 0, 1, kCamera, params);
  EXPECT_NEAR(boat.sigma / boat.range, 0.5, 1e-6);
  EXPECT_NEAR(person.sigma / person.range, params.height_spread, 1e-6);
}

TEST(RangeFromHeight, IsUnknownWhereTopOrBottomIsCut) {
  const ImageBox box = project(0, 0, 10, 1.7);
  EXPECT_TRUE(unknown(estimate(box, kCutTop)));
  EXPECT_TRUE(unknown(estimate(box, kCutBottom | kCutLeft)));
  EXPECT_FALSE(unknown(estimate(box, kCutLeft | kCutRight)));
}

TEST(RangeFromHeight, IsUnknownForAClassWithoutHeight) {
  EXPECT_TRUE(unknown(estimate(project(0, 0, 10, 1.7), 0, "kite")));
}

TEST(RangeFromHeight, IsUnknownWithoutCameraModelOrBox) {
  const ImageBox box = project(0, 0, 10, 1.7);
  EXPECT_TRUE(unknown(rangeFromHeight("person", box, 0, 1.0, Pinhole{}, RangeParams{})));
  EXPECT_TRUE(unknown(estimate({0, 10, 10, 10})));
  EXPECT_TRUE(unknown(estimate({0, 20, 10, 10})));
  EXPECT_TRUE(unknown(estimate({0, kNaN, 10, 10})));
  EXPECT_TRUE(unknown(estimate({kNaN, 0, 10, 10})));
}

TEST(RangeParams, DefaultsAreWithinTheirLimits) {
  RangeParams params;
  EXPECT_TRUE(declarationOf(params).faults().empty());
}

}  // namespace
}  // namespace field_fusion::core
