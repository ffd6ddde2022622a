#include "field_fusion/core/sim/colour_camera.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "camera_world.h"

namespace field_fusion::core::sim {
namespace {

using namespace test;

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

cv::Vec3b pixelAt(const ColourFrame& frame, const CameraParams& p, const Transform& T_world_sensor,
                  const Eigen::Vector3d& world) {
  const Eigen::Vector2d uv = Lens(p).project((T_world_sensor * sensorToOptical()).inverse() * world);
  return frame.image.at<cv::Vec3b>(static_cast<int>(std::lround(uv.y())),
                                   static_cast<int>(std::lround(uv.x())));
}

/// The wall of wallWorld under a sun at right angles and no sky.
World frontLit(float grey) {
  World world = wallWorld(grey);
  world.light = {{-1, 0, 0}, 1.0, 0.0};
  return world;
}
/// Green of that wall: the sun is a little yellow, and 10 m of haze swallow some.
double greenOf(float grey) {
  return grey / (0.2126 * 1.06 + 0.7152 + 0.0722 * 0.86) * std::exp(-10.0 / 6000.0);
}

TEST(ColourCamera, KnowsBodyAndRangeOfEveryPixel) {
  World world = worldOf(Sphere{{10, 0, 0}, 1.f});
  const ColourFrame frame = shoot(world, plainCamera(), Transform::Identity());
  EXPECT_EQ(frame.bodies.at<int>(240, 320), 0);
  EXPECT_NEAR(frame.ranges.at<float>(240, 320), 9.f, 1e-3f);
  EXPECT_EQ(frame.bodies.at<int>(0, 0), Hit::kNothing);
  // the edge of the sphere on the middle row
  const double r = 500.0 * std::tan(std::asin(0.1));
  EXPECT_EQ(frame.bodies.at<int>(240, static_cast<int>(319.5 + r - 1)), 0);
  EXPECT_EQ(frame.bodies.at<int>(240, static_cast<int>(319.5 + r + 2)), Hit::kNothing);
}

TEST(ColourCamera, LitOverShadowedIsLambertsLaw) {
  World world = worldOf(boxMesh({20, 20, 0.1f}), still({0, 0, -0.1}));
  world.bodies[0].model.links[0].parts[0].material.colour.setConstant(0.3f);
  world.light = {{0, 0.5, std::sqrt(0.75)}, 1.0, 0.35};
  world.bodies.push_back(bodyOf(boxMesh({1, 1, 0.01f}), still({0, 2 * std::tan(radians(30)), 2})));
  const Transform T = lookFrom({-5, 0, 5}, 0, radians(45));
  const ColourFrame frame = shoot(world, plainCamera(), T);
  const double lit = brightness(pixelAt(frame, plainCamera(), T, {0, -2, 0}));
  const double dark = brightness(pixelAt(frame, plainCamera(), T, {0, 0, 0}));
  const double wanted = (std::sqrt(0.75) + 0.35) / 0.35;
  EXPECT_NEAR(lit / dark, wanted, 0.025 * wanted);
  EXPECT_NEAR(lit, 0.3 * (std::sqrt(0.75) + 0.35), 0.01);
}

TEST(ColourCamera, TextureMovesWithItsBody) {
  World world = worldOf(boxMesh({2, 2, 2}), Trajectory({{{10, 0, -1}}, {{10, 5, -1}}}, {}));
  Material& material = world.bodies[0].model.links[0].parts[0].material;
  material.texture = Material::Texture::kChecker, material.colour2 = {0.05f, 0.05f, 0.05f};
  const double later = 2.0;
  const Eigen::Vector3d moved = world.bodies[0].way.pose(later).translation() - Eigen::Vector3d(10, 0, -1);
  Transform T0 = world.bodies[0].way.pose(0.0), T1 = world.bodies[0].way.pose(later);
  T0 = T0 * Eigen::AngleAxisd(-radians(90), Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-8, 0, 1);
  T1 = T1 * Eigen::AngleAxisd(-radians(90), Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(-8, 0, 1);
  ASSERT_GT(moved.norm(), 0.5);
  const auto different = [](const cv::Mat& a, const cv::Mat& b) {
    cv::Mat off;
    cv::extractChannel(cv::abs(a - b), off, 1);
    return cv::countNonZero(off > 8) / static_cast<double>(off.total());
  };
  const ColourFrame first = shoot(world, plainCamera(), T0), with = shoot(world, plainCamera(), T1, later);
  const ColourFrame left = shoot(world, plainCamera(), T0, later);
  EXPECT_LT(different(first.image, with.image), 0.002);
  EXPECT_GT(different(first.image, left.image), 0.02);
}

TEST(ColourCamera, NoiseHasTheSigmaOfItsElectrons) {
  CameraParams p = plainCamera();
  p.noise = true, p.full_well = 1000.0, p.read_noise = 10.0;
  for (const double gain : {0.0, 12.0}) {
    const double factor = std::pow(10.0, gain / 20.0), white = 1000.0 / factor;
    p.gain = gain, p.exposure_time = p.white_time / factor;
    const cv::Mat image = shoot(frontLit(0.45f), p, Transform::Identity()).image;
    double sum = 0.0, square = 0.0;
    for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(image)) {
      const double x = linearOf(pixel[1]);
      sum += x, square += x * x;
    }
    const double n = static_cast<double>(image.total()), mean = sum / n, wanted = greenOf(0.45f);
    EXPECT_NEAR(mean, wanted, 0.002);
    const double sigma = std::sqrt(wanted / white + 100.0 / (white * white));
    EXPECT_NEAR(std::sqrt(square / n - mean * mean), sigma, 0.02 * sigma) << gain << " dB";
  }
}

TEST(ColourCamera, CornersLoseWhatVignettingSays) {
  CameraParams p = plainCamera();
  p.vignetting = 0.4;
  const cv::Mat image = shoot(frontLit(0.6f), p, Transform::Identity()).image;
  EXPECT_NEAR(linearOf(image.at<cv::Vec3b>(240, 320)[1]), greenOf(0.6f), 0.01);
  EXPECT_NEAR(linearOf(image.at<cv::Vec3b>(0, 639)[1]), 0.6 * greenOf(0.6f), 0.01);
}

TEST(ColourCamera, TurningSmearsAnEdgeByAngleTimesFocalLength) {
  World world = worldOf(boxMesh({1, 100, 100}), still({10.5, -50, -50}));  // right half of the view
  world.light = {{-1, 0, 0}, 1.0, 0.0};
  CameraParams p = plainCamera();
  p.exposure_time = p.white_time = 20.0;
  for (const double rate : {0.0, 0.5, 1.0}) {
    Caster caster(world);
    ColourCamera camera(p, world, 1);
    const auto pose = [&](double time) { return lookFrom({0, 0, 0}, rate * (time - 3.0)); };
    const cv::Mat image = camera.run(caster, pose, 3.0).image;
    double sum = 0.0;  // of f (1 - f), a sixth of a ramp's length
    for (int u = 280; u < 360; ++u) {
      const double f = linearOf(image.at<cv::Vec3b>(240, u)[1]) / linearOf(image.at<cv::Vec3b>(240, 500)[1]);
      sum += f * (1.0 - f);
    }
    EXPECT_NEAR(6.0 * sum, 500.0 * rate * 0.02, 0.5) << rate << " rad/s";
  }
}

TEST(ColourCamera, MoreSamplesGiveAnEdgeItsShare) {
  // the edge lies at u = 319.5 + 0.25, so that pixel 320 shows 3/4 of the wall
  World world = worldOf(boxMesh({1, 100, 100}), still({10.5, -50 - 0.005, -50}));
  world.light = {{-1, 0, 0}, 1.0, 0.0};
  CameraParams p = plainCamera();
  p.samples = 4;
  const cv::Mat image = shoot(world, p, Transform::Identity()).image;
  const double share =
      linearOf(image.at<cv::Vec3b>(240, 320)[1]) / linearOf(image.at<cv::Vec3b>(240, 500)[1]);
  EXPECT_NEAR(share, 0.75, 0.03);
}

TEST(ColourCamera, GlareComesFromASunInViewAlone) {
  const auto glares = [](const World& world, double left) {
    CameraParams p = smallCamera();
    const Transform T = lookFrom({0, 0, 1}, left);
    const ColourFrame without = shoot(world, p, T);
    p.glare = 1.0;
    return !same(without.image, shoot(world, p, T).image);
  };
  World world;
  world.light.to_sun = Eigen::Vector3d(1, 0, 0.2).normalized();
  EXPECT_TRUE(glares(world, 0.0));
  EXPECT_TRUE(glares(world, 0.4));
  EXPECT_FALSE(glares(world, 0.7));  // half of the view is 0.57 rad wide
  EXPECT_FALSE(glares(world, 3.14));
  world.bodies.push_back(bodyOf(boxMesh({0.1f, 5, 5}), still({10, 0, 0})));
  EXPECT_FALSE(glares(world, 0.0));  // behind a wall
}

TEST(ColourCamera, WaterGlittersTowardsTheSun) {
  World world;
  world.ground.kind = Ground::Kind::kWater;
  world.ground.material.colour = {0.01f, 0.04f, 0.05f};
  world.light.to_sun = Eigen::Vector3d(1, 0, 0.4).normalized();
  const auto mean = [&](double left) {
    const ColourFrame frame = shoot(world, smallCamera(), lookFrom({0, 0, 3}, left, 0.35));
    double sum = 0.0;
    for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(frame.image(cv::Rect(50, 60, 60, 60))))
      sum += brightness(pixel);
    EXPECT_EQ(frame.bodies.at<int>(100, 80), Hit::kGround);
    return sum;
  };
  EXPECT_GT(mean(0.0), 1.3 * mean(3.14));
}

TEST(ColourCamera, FirstPictureIsAsBrightAsWanted) {
  CameraParams p = plainCamera();
  p.auto_exposure = true, p.brightness = 0.25;
  const ColourFrame frame = shoot(frontLit(0.05f), p, Transform::Identity());
  EXPECT_NEAR(brightness(frame.image.at<cv::Vec3b>(100, 100)), 0.25, 0.005);
}

TEST(ColourCamera, ExposureFollowsWhatItSees) {
  World world = wallWorld(0.6f);  // ahead; behind is darker
  world.bodies.push_back(bodyOf(Cylinder{{-10.f, 0.f, 0.f}, {-1.f, 0.f, 0.f}, 100.f}));
  world.bodies[1].model.links[0].parts[0].material.colour.setConstant(0.06f);
  world.light = {{0, 0, 1}, 0.0, 1.0};
  CameraParams p = smallCamera();
  p.auto_exposure = true, p.exposure_delay = 0.5, p.brightness = 0.2;
  Caster caster(world);
  ColourCamera camera(p, world, 1);
  const auto look = [&](double time) {
    const auto pose = [](double t) { return lookFrom({0, 0, 0}, t < 1.0 ? 0.0 : radians(180)); };
    return brightness(camera.run(caster, pose, time).image.at<cv::Vec3b>(60, 80));
  };
  EXPECT_NEAR(look(0.5), 0.2, 0.01);
  EXPECT_NEAR(look(1.5), 0.02, 0.005);
  for (double time = 1.6; time < 7.0; time += 0.1) look(time);
  EXPECT_NEAR(look(7.0), 0.2, 0.01);
}

TEST(ColourCamera, SameSeedGivesTheSameBytesInAnyNumberOfThreads) {
  World world;
  world.ground.kind = Ground::Kind::kWater;
  world.ground.waves = {{0.1, 7.0, 0.3, 0.0}};
  world.bodies.push_back(bodyOf(Sphere{{10, 0, 1}, 1.f}));
  world.bodies[0].label = "ball";
  CameraParams p = smallCamera();
  p.auto_exposure = p.noise = p.reflections = true, p.glare = 0.1;
  const auto film = [&](int threads, std::uint64_t seed) {
    p.threads = threads;
    Caster caster(world);
    ColourCamera camera(p, world, seed);
    cv::Mat strip;
    for (const double time : {0.0, 0.1, 0.2})
      strip.push_back(camera
                          .run(
                              caster,
                              [](double t) {
                                return lookFrom({0, 0, 2}, t);
                              },
                              time)
                          .image);
    return strip;
  };
  const cv::Mat one = film(1, 7);
  EXPECT_TRUE(same(one, film(1, 7)));
  EXPECT_TRUE(same(one, film(3, 7)));
  EXPECT_TRUE(same(one, film(0, 7)));
  EXPECT_FALSE(same(one, film(1, 8)));
}

TEST(ColourCamera, RefusesParametersOutOfRangeAndPosesThatAreNone) {
  const World world;
  CameraParams p = plainCamera();
  p.max_exposure_time = 50.0;  // longer than a picture
  EXPECT_THROW(ColourCamera(p, world, 1), std::invalid_argument);
  p = plainCamera(), p.rate = 0.0;
  EXPECT_THROW(ColourCamera(p, world, 1), std::invalid_argument);
  p = plainCamera(), p.width = 0;
  EXPECT_THROW(ColourCamera(p, world, 1), std::invalid_argument);
  Transform nowhere = Transform::Identity();
  nowhere.translation().x() = kNaN;
  EXPECT_THROW(shoot(world, plainCamera(), nowhere), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
