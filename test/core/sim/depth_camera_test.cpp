#include "field_fusion/core/sim/depth_camera.h"

#include <gtest/gtest.h>

#include "support/sim_worlds.h"

namespace field_fusion::core::sim {
namespace {

/// D435 without its errors, on which any surface that is not black has depth.
DepthCameraParams perfect() {
  DepthCameraParams p;
  p.disparity_noise = p.disparity_step = p.depth_step = p.match_noise = p.edge_loss = 0.0;
  p.projector_range = 1000.0;
  p.threads = 1;
  return p;
}

World wallAt(float distance, const Material& material = test::matt(0.5f)) {
  return test::worldOf({test::wallAhead("wall", distance, -100.f, 100.f, material)});
}

/// Pixels of the right half, which the right imager sees too.
std::vector<float> rightHalf(const DepthImage& image) {
  std::vector<float> out;
  for (int row = 0; row < image.height; ++row)
    for (int column = image.width / 2; column < image.width; ++column)
      out.push_back(image.metres[static_cast<std::size_t>(row) * image.width + column]);
  return out;
}

std::vector<float> rightHalf(const DepthCameraParams& params, const World& world) {
  Caster caster(world);
  return rightHalf(DepthCamera(params, 1).frame(caster, test::standing(), 0.0));
}

double shareSeen(const DepthCameraParams& params, const World& world) {
  const auto depths = rightHalf(params, world);
  return static_cast<double>(test::spreadOf(depths).count) / static_cast<double>(depths.size());
}

TEST(DepthCamera, MeasuresDepthAlongItsAxisExactly) {
  const World world = wallAt(3.f);
  Caster caster(world);
  DepthCamera camera(perfect(), 1);
  const double yaw = radians(30.0);
  const DepthImage& image = camera.frame(caster, test::standing(yaw), 2.5);
  EXPECT_EQ(image.stamp, 2.5);
  for (int column = 200; column < 640; column += 20) {
    // a ray of depth 1 points to (1, left); the wall's x is depth (cos - left sin)
    const double left = (319.5 - column) / image.focal_length;
    const double expected = 3.0 / (std::cos(yaw) - left * std::sin(yaw));
    EXPECT_NEAR(image.metres[100 * 640 + column], expected, 1e-5 * expected) << column;
  }
}

TEST(DepthCamera, ErrsWithTheSquareOfDepth) {
  DepthCameraParams p = perfect();
  p.disparity_noise = 0.08, p.noise_grain = 1;
  for (const double z : {1.0, 2.0, 4.0}) {
    const auto found = test::spreadOf(rightHalf(p, wallAt(static_cast<float>(z))));
    const double sigma = 0.08 * z * z / (p.focal_length * p.baseline);
    EXPECT_NEAR(found.sigma, sigma, 0.03 * sigma) << z;
    EXPECT_NEAR(found.mean, z, 0.03 * sigma + sigma * sigma / z) << z;  // 1 / disparity is curved
  }
}

TEST(DepthCamera, ErrorsOfNeighboursAreAlikeWithinTheGrain) {
  DepthCameraParams p = perfect();
  p.disparity_noise = 0.08, p.noise_grain = 8;
  const World world = wallAt(2.f);
  Caster caster(world);
  const DepthImage image = DepthCamera(p, 1).frame(caster, test::standing(), 0.0);
  std::vector<float> next, far;
  for (int row = 0; row < 480; ++row)
    for (int column = 320; column + 16 < 640; ++column) {
      const float* at = &image.metres[static_cast<std::size_t>(row) * 640 + column];
      next.push_back(at[1] - at[0]), far.push_back(at[16] - at[0]);
    }
  const double sigma = 0.08 * 4.0 / (p.focal_length * p.baseline);
  EXPECT_NEAR(test::spreadOf(rightHalf(image)).sigma, sigma, 0.06 * sigma);
  EXPECT_NEAR(test::spreadOf(far).sigma, std::sqrt(2.0) * sigma, 0.1 * sigma);
  EXPECT_LT(test::spreadOf(next).sigma, 0.4 * sigma);
}

TEST(DepthCamera, RoundsDepthToMillimetres) {
  DepthCameraParams p = perfect();
  p.depth_step = 0.001;
  for (const float z : rightHalf(p, wallAt(3.0002f))) EXPECT_FLOAT_EQ(z, 3.f);
}

TEST(DepthCamera, RoundsDisparityToItsStep) {
  DepthCameraParams p = perfect();
  p.disparity_step = 0.03125;
  const double unit = p.focal_length * p.baseline, found = rightHalf(p, wallAt(3.f)).front();
  const double steps = unit / found / p.disparity_step;
  EXPECT_NEAR(steps, std::round(steps), 1e-3);
  EXPECT_NEAR(unit / found, unit / 3.0, 0.5 * p.disparity_step);
}

TEST(DepthCamera, SeesFromItsMinimumToItsMaximumRange) {
  EXPECT_EQ(shareSeen(perfect(), wallAt(0.279f)), 0.0);
  EXPECT_EQ(shareSeen(perfect(), wallAt(0.281f)), 1.0);
  EXPECT_EQ(shareSeen(perfect(), wallAt(9.99f)), 1.0);
  EXPECT_EQ(shareSeen(perfect(), wallAt(10.01f)), 0.0);
}

TEST(DepthCamera, HasNoDepthAtTheLeftMarginThatTheRightImagerMisses) {
  const World world = wallAt(1.f);
  Caster caster(world);
  const DepthImage image = DepthCamera(perfect(), 1).frame(caster, test::standing(), 0.0);
  const float margin = static_cast<float>(399.4 * 0.05);  // the disparity: 19.97 px
  for (int column = 0; column < 640; ++column)
    EXPECT_EQ(std::isnan(image.metres[column]), static_cast<float>(column) - margin < -0.5f) << column;
}

TEST(DepthCamera, HasNoDepthWhereAnEdgeHidesTheGroundBehindItFromTheRightImager) {
  // a wall 1 m ahead to the right, another 2 m ahead; the left one sees more of that beside the edge
  const World world = test::worldOf({test::wallAhead("near", 1.f, -50.f, 0.f, test::matt(0.5f)),
                                     test::wallAhead("far", 2.f, -50.f, 50.f, test::matt(0.5f))});
  Caster caster(world);
  DepthCamera camera(perfect(), 1);
  const DepthImage& image = camera.frame(caster, test::standing(), 0.0);
  int holes = 0;
  for (int column = 100; column < 640; ++column) {
    if (!std::isnan(image.metres[column])) continue;
    EXPECT_EQ(camera.truth().bodies[column], 1) << column;
    ++holes;
  }
  EXPECT_NEAR(holes, 399.4 * 0.05 * (1.0 / 1.0 - 1.0 / 2.0), 1.01);  // the step in disparity
}

TEST(DepthCamera, LosesPixelsBesideSteps) {
  const World world = test::worldOf({test::wallAhead("near", 1.f, 0.f, 50.f, test::matt(0.5f)),
                                     test::wallAhead("far", 2.f, -50.f, 50.f, test::matt(0.5f))});
  Caster caster(world);
  DepthCameraParams p = perfect();
  p.edge_loss = 0.3;
  DepthCamera camera(p, 1);
  const DepthImage& image = camera.frame(caster, test::standing(), 0.0);
  int lost = 0, elsewhere = 0;
  for (int row = 0; row < 480; ++row)
    for (int column = 100; column < 640; ++column)
      if (std::isnan(image.metres[static_cast<std::size_t>(row) * 640 + column]))
        ++(std::abs(column - 319.5) < 1.0 ? lost : elsewhere);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_NEAR(lost, 0.3 * 2 * 480, 4.0 * std::sqrt(0.3 * 0.7 * 2 * 480));
}

TEST(DepthCamera, LosesDarkGlossyAndFarSurfacesWithoutTexture) {
  DepthCameraParams p = perfect();
  p.projector_range = 4.0;
  EXPECT_EQ(shareSeen(p, wallAt(1.5f, test::matt(0.5f))), 1.0);
  EXPECT_EQ(shareSeen(p, wallAt(1.5f, test::matt(0.05f))), 0.0);
  EXPECT_EQ(shareSeen(p, wallAt(5.f, test::matt(0.5f))), 0.0);
  Material glossy = test::matt(0.5f);
  glossy.gloss = 0.95f;
  EXPECT_EQ(shareSeen(p, wallAt(1.5f, glossy)), 0.0);
}

TEST(DepthCamera, SeesTextureWhereItsProjectorDoesNotReach) {
  DepthCameraParams p = perfect();
  p.projector_range = 1.0;
  Material bricks = test::matt(0.5f);
  bricks.texture = Material::Texture::kBricks;
  bricks.colour.setConstant(0.8f), bricks.colour2.setConstant(0.2f);
  EXPECT_EQ(shareSeen(p, wallAt(5.f, bricks)), 1.0);
  bricks.texture_size = 0.005f;  // a fifth of two pixels
  EXPECT_EQ(shareSeen(p, wallAt(5.f, bricks)), 0.0);
}

TEST(DepthCamera, LosesEveryOtherPixelAtTheProjectorsReach) {
  DepthCameraParams p = perfect();
  p.width = 64, p.height = 64, p.projector_range = 4.0, p.match_noise = 0.3, p.noise_grain = 1;
  p.focal_length = 4000.0, p.baseline = 0.001;  // all pixels as good as square on
  EXPECT_NEAR(shareSeen(p, wallAt(4.f, test::matt(1.f))), 0.5, 4.0 * 0.5 / std::sqrt(64 * 32));
}

TEST(DepthCamera, SendsMillimetresWithZeroForNone) {
  const World world = wallAt(1.2342f);
  Caster caster(world);
  DepthCamera camera(perfect(), 1);
  const DepthImage& image = camera.frame(caster, test::standing(), 0.0);
  EXPECT_EQ(image.millimetres.front(), 0);
  EXPECT_EQ(image.millimetres.back(), 1234);
  EXPECT_EQ(camera.truth().bodies.front(), 0);
  EXPECT_NEAR(camera.truth().metres.front(), 1.2342, 1e-5);
}

TEST(DepthCamera, DoesNotDependOnThreadsButOnTheSeed) {
  const World world = wallAt(3.f);
  Caster caster(world);
  const auto frame = [&](std::uint64_t seed, int threads) {
    DepthCameraParams p;
    p.depth_scale = 0.01, p.threads = threads;
    return DepthCamera(p, seed).frame(caster, test::standing(), 0.0).millimetres;
  };
  EXPECT_EQ(frame(1, 1), frame(1, 7));
  EXPECT_NE(frame(1, 1), frame(2, 1));
}

TEST(DepthCamera, ErrsByItsScale) {
  DepthCameraParams p = perfect();
  p.depth_scale = 0.02;
  const World world = wallAt(3.f);
  Caster caster(world);
  DepthCamera camera(p, 3);
  EXPECT_NE(camera.scale(), 0.0);
  EXPECT_LE(std::abs(camera.scale()), 0.02);
  EXPECT_NEAR(camera.frame(caster, test::standing(), 0.0).metres.back(), 3.0 * (1.0 + camera.scale()), 1e-4);
}

TEST(DepthCamera, RefusesParametersThatMakeNoCamera) {
  const auto refused = [](auto change) {
    DepthCameraParams p;
    change(p);
    EXPECT_THROW(DepthCamera(p, 1), std::invalid_argument);
  };
  refused([](auto& p) { p.rate = 0.0; });
  refused([](auto& p) { p.width = 0; });
  refused([](auto& p) { p.baseline = 0.0; });
  refused([](auto& p) { p.noise_grain = 0; });
  refused([](auto& p) { p.min_range = 20.0; });
}

}  // namespace
}  // namespace field_fusion::core::sim
