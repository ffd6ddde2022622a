#include "field_fusion/core/sim/lens.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "camera_world.h"
#include "field_fusion/core/sim/sensor_models.h"

namespace field_fusion::core::sim {
namespace {

using test::plainCamera;

CameraParams wide() {
  CameraParams p;
  p.fx = p.fy = 340.0;
  p.k1 = -0.25, p.k2 = 0.06, p.k3 = -0.005, p.p1 = 0.001, p.p2 = -0.0005;
  return p;
}

double angleBetween(const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.cross(b).norm(); }

TEST(Lens, WithoutDistortionAPixelIsWhereThePinholeSays) {
  const Lens lens(plainCamera());
  const Eigen::Vector2d p = lens.project({1.0, -2.0, 10.0});
  EXPECT_NEAR(p.x(), 319.5 + 50.0, 1e-9);
  EXPECT_NEAR(p.y(), 239.5 - 100.0, 1e-9);
  EXPECT_LT((lens.ray(0, 0) - Eigen::Vector3f(-0.639f, -0.479f, 1.f).normalized()).norm(), 1e-6f);
}

TEST(Lens, DistortionIsThatOfPlumbBob) {
  const CameraParams p = wide();
  const Lens lens(p);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const double x = side(random), y = side(random), r2 = x * x + y * y;
    const double radial = 1 + p.k1 * r2 + p.k2 * r2 * r2 + p.k3 * r2 * r2 * r2;
    const double xd = x * radial + 2 * p.p1 * x * y + p.p2 * (r2 + 2 * x * x);
    const double yd = y * radial + p.p1 * (r2 + 2 * y * y) + 2 * p.p2 * x * y;
    const Eigen::Vector2d pixel = lens.project({3 * x, 3 * y, 3.0});
    EXPECT_NEAR(pixel.x(), p.fx * xd + p.cx, 1e-9);
    EXPECT_NEAR(pixel.y(), p.fy * yd + p.cy, 1e-9);
  }
}

TEST(Lens, RayOfEveryPixelProjectsBackToIt) {
  for (const CameraParams& p : {plainCamera(), wide()}) {
    const Lens lens(p);
    double worst = 0.0;
    for (int v = 0; v < p.height; v += 7)
      for (int u = 0; u < p.width; u += 7)
        worst = std::max(worst, (lens.project(lens.ray(u, v).cast<double>()) - Eigen::Vector2d(u, v)).norm());
    EXPECT_LT(worst, 1e-3);
  }
}

TEST(Lens, RayBesideTheMiddleProjectsBackToItsPlace) {
  const Lens lens(wide());
  for (const int u : {0, 100, 639})
    for (const int v : {0, 200, 479}) {
      const float right = u == 0 ? 0.4f : -0.4f, down = v == 0 ? 0.3f : -0.3f;
      const Eigen::Vector2d there = lens.project(lens.ray(u, v, right, down).cast<double>());
      EXPECT_LT((there - Eigen::Vector2d(u + right, v + down)).norm(), 0.01);
    }
}

TEST(Lens, WideLensSeesMoreThanItsFocalLengthSays) {
  const Lens lens(wide());
  const double seen = degrees(std::asin(angleBetween(lens.ray(0, 240), Eigen::Vector3f::UnitZ())));
  EXPECT_GT(seen, degrees(std::atan(320.0 / 340.0)) + 5.0);
}

TEST(Lens, DistortionThatFoldsThePictureIsRefused) {
  CameraParams p = plainCamera();
  p.k1 = -1.0;
  EXPECT_THROW(Lens{p}, std::invalid_argument);
}

TEST(Lens, BehindIsNoPixel) {
  const Lens lens(plainCamera());
  EXPECT_TRUE(std::isnan(lens.project({0.1, 0.1, -1.0}).x()));
  EXPECT_TRUE(std::isnan(lens.project({0.1, 0.1, 0.0}).x()));
}

TEST(Lens, EveryCameraInConfigIsDeclaredAndSeesWhatItsFileSays) {
  for (const auto& [name, wanted_deg] :
       std::map<std::string, double>{
           {"camera_640", 51.0}, {"camera_1080p", 59.0}, {"wide_105", 105.0}, {"xfk_4k415", 105.0}}) {
    CameraParams params;
    Params declared = declarationOf(params);
    readSensorFile(PROJECT_DIR "/config/sensors/" + name + ".yaml", {}, declared);
    const Lens lens(params);
    const int middle = params.height / 2;
    const double across = std::acos(lens.ray(0, middle).dot(lens.ray(params.width - 1, middle)));
    EXPECT_NEAR(degrees(across), wanted_deg, 1.5) << name;
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
