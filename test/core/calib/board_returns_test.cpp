#include "field_fusion/core/calib/board_returns.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion::core {
namespace {

const Board kBoard{8, 6, 0.1};

/// Faces the LiDAR 2 m ahead, turned.
Transform boardAhead() {
  Transform T = Transform::Identity();
  T.linear().col(0) = -Eigen::Vector3d::UnitY();
  T.linear().col(1) = -Eigen::Vector3d::UnitZ();
  T.linear().col(2) = Eigen::Vector3d::UnitX();
  T.translation() << 2.0, 0.2, 0.1;
  T.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()));
  return T;
}

/// Of a board and a wall 1.5 m behind it: rays from a grid of directions. The first `board` returns are the board's.
struct Scene {
  Cloud cloud;
  std::size_t board = 0;
};

Scene scene(bool flat, double noise) {
  std::mt19937 random(1);
  std::normal_distribution<> error(0.0, noise);
  const Transform T = boardAhead(), T_board_lidar = T.inverse();
  Cloud wall;
  Scene out;
  for (int row = flat ? 0 : -10; row <= (flat ? 0 : 10); ++row)
    for (double azimuth = -0.6; azimuth < 0.6; azimuth += 0.004) {
      const Eigen::Vector3d ray = cartesian({1.0, azimuth, radians(2.0 * row)});
      const double range = -T_board_lidar.translation().z() / (T_board_lidar.linear() * ray).z();
      const Eigen::Vector3d at = T_board_lidar * (range * ray);
      const bool hit = std::abs(at.x()) < kBoard.width() / 2 && std::abs(at.y()) < kBoard.height() / 2;
      const Eigen::Vector3f p = (((hit ? range : 3.5 / ray.x()) + error(random)) * ray).cast<float>();
      Point point;
      point.x = p.x(), point.y = p.y(), point.z = p.z();
      point.ring = static_cast<std::uint16_t>(row + 10);
      (hit ? out.cloud : wall).push_back(point);
    }
  out.board = out.cloud.size();
  out.cloud.insert(out.cloud.end(), wall.begin(), wall.end());
  return out;
}

class Both : public testing::TestWithParam<bool> {};

TEST_P(Both, TheBoardsReturnsAreFoundAboutAWrongGuess) {
  const Scene s = scene(GetParam(), 0.005);
  Transform guess = boardAhead();
  guess.pretranslate(Eigen::Vector3d(0.06, -0.05, 0.04));
  guess.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()));
  const auto found = returnsNear(s.cloud, kBoard, guess, {});
  EXPECT_GE(found.size(), s.board * 95 / 100);
  for (const auto i : found) EXPECT_LT(i, s.board);
}

TEST_P(Both, InsideTheKnownOutlineAreTheReturnsThatAreWhollyOnTheBoard) {
  const Scene s = scene(GetParam(), 0.0);
  const auto found = returnsOn(s.cloud, kBoard, boardAhead(), {});
  EXPECT_GE(found.size(), s.board * 85 / 100);
  for (const auto i : found) {
    ASSERT_LT(i, s.board);
    const Eigen::Vector3d p = boardAhead().inverse() * s.cloud[i].position().cast<double>();
    EXPECT_LE(std::abs(p.x()), kBoard.width() / 2 - 0.02);
    EXPECT_LE(std::abs(p.y()), kBoard.height() / 2 - 0.02);
  }
  EXPECT_TRUE(returnsOn({}, kBoard, boardAhead(), {}).empty());
}

TEST_P(Both, NothingIsFoundWhereNothingIs) {
  const Scene s = scene(GetParam(), 0.005);
  Transform elsewhere = boardAhead();
  elsewhere.pretranslate(Eigen::Vector3d(-1.0, 0.0, 0.0));
  EXPECT_TRUE(returnsNear(s.cloud, kBoard, elsewhere, {}).empty());
  EXPECT_TRUE(returnsNear({}, kBoard, boardAhead(), {}).empty());
  EXPECT_TRUE(returnsNear({s.cloud[0]}, kBoard, boardAhead(), {}).empty());
  Cloud nowhere = s.cloud;
  for (Point& p : nowhere) p.x = kNaN;
  EXPECT_TRUE(returnsNear(nowhere, kBoard, boardAhead(), {}).empty());
}

TEST_P(Both, WithoutAGuessTheBoardIsTheOnePieceOfItsSize) {
  const Scene s = scene(GetParam(), 0.005);
  const auto found = boardCandidates(s.cloud, kBoard, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GE(found[0].size(), s.board * 95 / 100);
  for (const auto i : found[0]) EXPECT_LT(i, s.board);
  EXPECT_TRUE(boardCandidates(s.cloud, {8, 6, 0.02}, {}).empty());
  EXPECT_TRUE(boardCandidates({}, kBoard, {}).empty());
}

INSTANTIATE_TEST_SUITE_P(Returns, Both, testing::Bool(), [](const auto& info) { return info.param ? "flat" : "cloud"; });

TEST(ReturnMeans, AreThoseOfOneLaserInOneDirection) {
  Point a, b, c, d;
  a.x = 2.0f, b.x = 2.2f, a.y = b.y = 0.001f, c = a, d = a;
  a.ring = b.ring = 3, c.ring = 4, d.x = kNaN, d.ring = 3;
  ReturnMeans means;
  means.add({a, b, c, d}, {0, 1, 2, 3});
  const auto out = means.means();
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].laser, 3);
  EXPECT_EQ(out[0].count, 2);
  EXPECT_NEAR(out[0].position.x(), 2.1, 1e-6);
  EXPECT_EQ(out[1].laser, 4);
  EXPECT_EQ(out[1].count, 1);
  EXPECT_TRUE(ReturnMeans().means().empty());
}

}  // namespace
}  // namespace field_fusion::core
