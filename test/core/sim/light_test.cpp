// What a world's keys of light and material do to a camera's picture.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "camera_world.h"

namespace field_fusion::core::sim {
namespace {

using namespace test;

World skyAlone() {
  World world;
  world.ground.kind = Ground::Kind::kNone;
  world.light.to_sun = {0, 0, 1};
  return world;
}

cv::Mat sky(const Light& light) {
  World world = skyAlone();
  world.light = light;
  return shoot(world, smallCamera(), lookFrom({0, 0, 2}, 0, radians(-40))).image;
}

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

/// Mean of blue over red: 1 is grey.
double blueness(const cv::Mat& image) {
  const cv::Scalar mean = cv::mean(image);
  return mean[2] / mean[0];
}

TEST(Light, AnotherSeedIsAnotherSkyUnlessThereAreNoClouds) {
  Light a = skyAlone().light, b = a;
  b.cloud_seed = 1;
  EXPECT_TRUE(same(sky(a), sky(a)));
  EXPECT_FALSE(same(sky(a), sky(b)));
  a.clouds = b.clouds = 0.0;
  EXPECT_TRUE(same(sky(a), sky(b)));
}

TEST(Light, TheMoreCloudsTheGreyerTheSky) {
  Light light = skyAlone().light;
  std::vector<double> blue;
  for (const double clouds : {0.0, 0.5, 1.0}) light.clouds = clouds, blue.push_back(blueness(sky(light)));
  EXPECT_GT(blue[0], blue[1]);
  EXPECT_GT(blue[1], blue[2]);
  EXPECT_LT(blue[2], 1.2);
}

TEST(Light, ColoursOfZenithAndHorizonAreSeen) {
  Light light = skyAlone().light;
  light.clouds = 0.0, light.zenith = light.horizon = {0.2f, 0.4f, 0.2f};
  light.sun = 0.0, light.sky = 0.4;
  // of one colour all over, its brightness that of the sky; no clouds
  const cv::Vec3b pixel = sky(light).at<cv::Vec3b>(60, 80);
  EXPECT_NEAR(linearOf(pixel[1]) / linearOf(pixel[0]), 2.0, 0.05);
  EXPECT_NEAR(brightness(pixel), 0.4, 0.01);
}

TEST(Light, AYellowSunMakesAWhiteWallYellow) {
  World world = wallWorld(0.8f);
  world.light.to_sun = {-1, 0, 0}, world.light.sun = 1.0, world.light.sky = 0.0;
  world.light.sun_colour = {1.f, 1.f, 0.25f};
  const cv::Vec3b pixel = shoot(world, smallCamera(), Transform::Identity()).image.at<cv::Vec3b>(60, 80);
  EXPECT_NEAR(linearOf(pixel[2]) / linearOf(pixel[1]), 0.25, 0.01);
}

TEST(Light, HazeTakesAllBut1OverEWithinTheVisibility) {
  World world = wallWorld(0.f);  // black, 10 m ahead: what is seen is haze
  world.light.sun = 0.0, world.light.sky = 0.4;
  const auto haze = [&](double visibility) {
    world.light.visibility = visibility;
    return brightness(shoot(world, smallCamera(), Transform::Identity()).image.at<cv::Vec3b>(60, 80));
  };
  const double whole = haze(0.1);
  EXPECT_NEAR(haze(10.0) / whole, 1.0 - std::exp(-1.0), 0.01);
  EXPECT_NEAR(haze(40.0) / whole, 1.0 - std::exp(-0.25), 0.01);
}

/// A wall at x = 10 m of two greys in squares of 1 m or so, lit from all sides.
cv::Mat wallOf(Material::Texture texture, float wear = 0.f) {
  World world = wallWorld(0.8f);
  Material& material = world.bodies[0].model.links[0].parts[0].material;
  material.texture = texture, material.texture_size = 1.f, material.wear = wear;
  material.colour2.setConstant(0.1f);
  world.light.sun = 0.0, world.light.sky = 1.0;
  cv::Mat green;
  cv::extractChannel(shoot(world, smallCamera(), Transform::Identity()).image, green, 1);
  return green;
}

/// Share of pixels of the wall's other colour.
double darkShare(const cv::Mat& green) {
  return cv::countNonZero(green < 160) / static_cast<double>(green.total());  // linear 0.35
}

TEST(Texture, PatternsCoverTheShareOfTheirShapes) {
  using Texture = Material::Texture;
  EXPECT_EQ(darkShare(wallOf(Texture::kPlain)), 0.0);
  // The wall cuts balls of radius 0.4 at 0.3137 from their middles.
  EXPECT_NEAR(darkShare(wallOf(Texture::kDots)), M_PI * (0.16 - 0.3137 * 0.3137), 0.03);
  EXPECT_NEAR(darkShare(wallOf(Texture::kGrid)), 1.0 - 0.9 * 0.9, 0.04);
  EXPECT_NEAR(darkShare(wallOf(Texture::kSlants)), 0.5, 0.1);
  EXPECT_NEAR(darkShare(wallOf(Texture::kBlotches)), 0.5, 0.2);
}

TEST(Texture, PlanksAreOfOneShadeEachFromTopToBottom) {
  const cv::Mat planks = wallOf(Material::Texture::kPlanks);
  for (int v = 0; v < planks.rows; v += 10)
    EXPECT_LE(cv::norm(planks.row(v), planks.row(60), cv::NORM_INF), 2) << v;
  double low, high;
  cv::minMaxLoc(planks, &low, &high);
  EXPECT_GT(high - low, 40);
}

TEST(Texture, SlantsRiseByTheirAngle) {
  const cv::Mat slants = wallOf(Material::Texture::kSlants);  // one metre to the left is one down
  int different = 0;
  for (int i = 0; i < 40; ++i)
    different += std::abs(slants.at<uchar>(40 + i, 60 + i) - slants.at<uchar>(40, 60)) > 40;
  const int along = different;
  different = 0;
  for (int i = 0; i < 40; ++i)
    different += std::abs(slants.at<uchar>(79 - i, 60 + i) - slants.at<uchar>(79, 60)) > 40;
  EXPECT_EQ(std::min(along, different), 0);
  EXPECT_GT(std::max(along, different), 5);
}

TEST(Texture, WedgesMeetAtTheAxis) {
  World world = worldOf(Sphere{{0, 0, 0}, 1.f}, still({0, 0, 0}));
  Material& material = world.bodies[0].model.links[0].parts[0].material;
  material.texture = Material::Texture::kWedges, material.colour.setConstant(0.8f),
  material.colour2.setConstant(0.1f);
  world.light.sun = 0.0, world.light.sky = 1.0;
  cv::Mat green;
  const CameraParams p = smallCamera();
  cv::extractChannel(shoot(world, p, lookFrom({0, 0, 5}, 0, radians(90))).image, green, 1);
  int changes = 0;
  const auto at = [&](int degrees) {  // half-way to the rim
    const double r = 0.5 / 4.2 * p.fx;
    return green.at<uchar>(static_cast<int>(59.5 + r * std::sin(radians(degrees))),
                           static_cast<int>(79.5 + r * std::cos(radians(degrees)))) < 160;
  };
  for (int degrees = 0; degrees < 360; ++degrees) changes += at(degrees) != at(degrees + 1);
  EXPECT_EQ(changes, 8);
}

TEST(Texture, WearDarkensInPatches) {
  const cv::Mat clean = wallOf(Material::Texture::kPlain), worn = wallOf(Material::Texture::kPlain, 0.8f);
  double low, high;
  cv::minMaxLoc(worn, &low, &high);
  EXPECT_LT(cv::mean(worn)[0], cv::mean(clean)[0] - 5);
  EXPECT_GT(high - low, 30);
}

}  // namespace
}  // namespace field_fusion::core::sim
