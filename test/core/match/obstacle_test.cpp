#include "field_fusion/core/match/obstacle.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "support/bodies.h"

namespace field_fusion::core {
namespace {

const ObstacleParams kParams{0.1, 2.0, 0.6, 0.8};

LidarTarget box(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  LidarTarget out;
  out.place = 3;
  out.cluster.box = {low, high};
  out.cluster.centre = out.cluster.box.center();
  out.cluster.polar = polar(out.cluster.centre.cast<double>());
  return out;
}

CameraTarget seen(const Eigen::Vector3d& ray, double range, double sigma, const Eigen::Vector3d& camera) {
  CameraTarget out;
  out.id = 7;
  out.label = "boat";
  out.score = 0.5;
  out.ray_range = range;
  out.range_sigma = sigma;
  carryToLidar(out, ray.normalized(), test::lookingAhead(camera));
  return out;
}

bool positiveDefinite(const Eigen::Matrix3d& m) {
  return m == m.transpose() &&
         Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues().minCoeff() > 0.0;
}

TEST(CarryToLidar, CountsThePlaceOfTheCamera) {
  const CameraTarget target = seen({0, 0, 1}, 4.0, 0.1, {1, 3, 0});
  EXPECT_TRUE(target.position.isApprox(Eigen::Vector3d(5, 3, 0)));
  EXPECT_TRUE(target.direction.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(target.polar.range, std::sqrt(34.0), 1e-12);
  EXPECT_NEAR(target.polar.azimuth, std::atan2(3, 5), 1e-12);
}

TEST(CarryToLidar, RightInTheImageIsNegativeAzimuthAndDownNegativeElevation) {
  const CameraTarget target = seen({1, 1, 1}, 1.0, 0.1, {0, 0, 0});
  EXPECT_NEAR(target.polar.azimuth, radians(-45), 1e-12);
  EXPECT_NEAR(target.polar.elevation, -std::atan(std::sqrt(0.5)), 1e-12);
}

TEST(CarryToLidar, WithoutRangeKeepsTheDirection) {
  const CameraTarget target = seen({0, 0, 1}, kNaN, kNaN, {1, 3, 0});
  EXPECT_TRUE(target.position.array().isNaN().all());
  EXPECT_TRUE(std::isnan(target.polar.range));
  EXPECT_DOUBLE_EQ(target.polar.azimuth, 0.0);
}

TEST(CarryToLidar, RayThatIsNotFiniteLeavesAllUnknown) {
  const CameraTarget target = seen({kNaN, 0, 1}, 4.0, 0.1, {0, 0, 0});
  EXPECT_TRUE(target.position.array().isNaN().all());
  EXPECT_TRUE(std::isnan(target.polar.azimuth));
}

TEST(LidarObstacle, TakesTheBox) {
  const Obstacle o = lidarObstacle(box({4, -1, 0}, {6, 1, 1}), {}, kParams);
  EXPECT_EQ(o.cluster, 3);
  EXPECT_EQ(o.detection, -1);
  EXPECT_EQ(o.source, ObstacleSource::kLidar);
  EXPECT_TRUE(o.position.isApprox(Eigen::Vector3d(5, 0, 0.5)));
  EXPECT_TRUE(o.size.isApprox(Eigen::Vector3d(2, 2, 1)));
  EXPECT_NEAR(o.polar.range, std::sqrt(25.25), 1e-6);
  EXPECT_DOUBLE_EQ(o.existence, 0.6);
  EXPECT_TRUE(o.label.empty());
  EXPECT_TRUE(std::isnan(o.label_probability));
}

TEST(LidarObstacle, CovarianceIsThatOfAnEvenSpreadOverTheBoxAndTheNoise) {
  const LidarTarget body = box({4, -1, 0}, {6, 1, 1});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kParams.lidar_range_sigma);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d e(2 * unit(random) + noise(random), 2 * unit(random) + noise(random),
                            unit(random) + noise(random));
    sum += e * e.transpose();
  }
  EXPECT_LT((lidarObstacle(body, {}, kParams).covariance - sum / n).cwiseAbs().maxCoeff(), 0.005);
}

TEST(LidarObstacle, SinglePointHasAPositiveDefiniteCovariance) {
  EXPECT_TRUE(positiveDefinite(lidarObstacle(box({4, 0, 0}, {4, 0, 0}), {}, kParams).covariance));
}

TEST(CameraObstacle, ErrorOfTheRangeLiesAlongTheRay) {
  const Eigen::Vector3d camera(0.3, -0.2, 0.1);
  const Obstacle o = cameraObstacle(2, seen({0.4, 0.2, 1}, 10.0, 2.0, camera), {}, kParams);
  EXPECT_TRUE(positiveDefinite(o.covariance));
  const Eigen::Vector3d ray = (o.position - camera).normalized();
  const Eigen::Vector3d across = ray.unitOrthogonal();
  EXPECT_NEAR(ray.dot(o.covariance * ray), 4.0, 1e-9);
  EXPECT_NEAR(std::sqrt(across.dot(o.covariance * across)), 10.0 * std::tan(radians(2.0)), 1e-9);
}

TEST(CameraObstacle, WithoutRangeIsADirection) {
  const Obstacle o = cameraObstacle(2, seen({0, 0, 1}, kNaN, kNaN, {0, 0, 0}), {}, kParams);
  EXPECT_EQ(o.source, ObstacleSource::kCamera);
  EXPECT_EQ(o.cluster, -1);
  EXPECT_EQ(o.camera, 2);
  EXPECT_EQ(o.detection, 7);
  EXPECT_TRUE(o.position.array().isNaN().all());
  EXPECT_TRUE(o.covariance.array().isNaN().all());
  EXPECT_TRUE(o.size.array().isNaN().all());
  EXPECT_DOUBLE_EQ(o.polar.azimuth, 0.0);
  EXPECT_DOUBLE_EQ(o.polar.elevation, 0.0);
  EXPECT_EQ(o.label, "boat");
  EXPECT_DOUBLE_EQ(o.existence, 0.8 * 0.5);
}

TEST(CameraObstacle, UnknownSigmaLeavesTheCovarianceUnknown) {
  for (const double sigma : {double(kNaN), 0.0}) {
    const Obstacle o = cameraObstacle(2, seen({0, 0, 1}, 5.0, sigma, {0, 0, 0}), {}, kParams);
    EXPECT_TRUE(o.position.allFinite());
    EXPECT_TRUE(o.covariance.array().isNaN().all());
  }
}

TEST(MatchedObstacle, TakesPlaceFromTheLidarAndClassFromTheCamera) {
  const LidarTarget body = box({4, -1, 0}, {6, 1, 1});
  const CameraTarget target = seen({0, 0, 1}, 5.5, 0.5, {0, 0, 0});
  const Obstacle o = matchedObstacle(body, 1, target, {0, MatchReason::kMatched, -0.5, 0.0}, kParams);
  EXPECT_EQ(o.source, ObstacleSource::kBoth);
  EXPECT_EQ(o.cluster, 3);
  EXPECT_EQ(o.camera, 1);
  EXPECT_EQ(o.detection, 7);
  EXPECT_TRUE(o.position.isApprox(Eigen::Vector3d(5, 0, 0.5)));
  EXPECT_DOUBLE_EQ(o.polar.range, body.cluster.polar.range);
  EXPECT_EQ(o.label, "boat");
  EXPECT_DOUBLE_EQ(o.label_probability, 0.5);
  EXPECT_DOUBLE_EQ(o.existence, 1.0 - 0.4 * 0.6);
  EXPECT_EQ(o.verdict.reason, MatchReason::kMatched);
}

}  // namespace
}  // namespace field_fusion::core
