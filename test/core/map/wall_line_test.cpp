#include "field_fusion/core/map/wall_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core {
namespace {

/// Of a straight wall: cells around the one at the origin whose middle is nearer than 0.7 cells to the line at `off` [cells]
/// from the middle of the one; the mean of each is the foot of its middle on the line.
HitsAround straight(double angle, double off) {
  const double nx = -std::sin(angle), ny = std::cos(angle);
  HitsAround out;
  const auto foot = [&](int u, int v, double& x, double& y) {
    const double d = nx * u + ny * v - off;
    x = u - d * nx, y = v - d * ny;
    return std::abs(d) < 0.7;
  };
  double own_x = 0, own_y = 0, x = 0, y = 0;
  foot(0, 0, own_x, own_y);
  for (int v = -2; v <= 2; ++v)
    for (int u = -2; u <= 2; ++u)
      if (foot(u, v, x, y)) out.add(static_cast<float>(x - own_x), static_cast<float>(y - own_y), static_cast<float>(1 + (u + v) * (u + v)));
  return out;
}

void expectNormal(const WallLine& line, double angle, double tolerance) {
  EXPECT_NEAR(std::abs(-std::sin(angle) * line.nx + std::cos(angle) * line.ny), 1.0, tolerance) << angle;
  EXPECT_NEAR(std::hypot(line.nx, line.ny), 1.0, 1e-5);
}

TEST(WallLine, IsExactOnPointsOfALineOfAnyDirection) {
  for (int degrees = 0; degrees < 180; degrees += 5)
    for (const double off : {-0.4, 0.0, 0.3}) {
      const auto line = wallLine(straight(radians(degrees), off));
      ASSERT_TRUE(line) << degrees;
      expectNormal(*line, radians(degrees), 1e-5);
      EXPECT_NEAR(line->off, 0.0, 1e-4);  // the mean of the one lies on the line
    }
}

TEST(WallLine, LiesAmongTheHitsOfAWallOnTheEdgeOfTwoRows) {
  // the hits scatter about y = 0 by the same both ways: the row beyond has its means at +0.2, the row before at -0.2
  HitsAround around;
  for (int u = -2; u <= 2; ++u) around.add(static_cast<float>(u), 0.f, 6.f), around.add(static_cast<float>(u), -0.4f, 6.f);
  const auto line = wallLine(around);
  ASSERT_TRUE(line);
  expectNormal(*line, 0.0, 1e-5);
  EXPECT_NEAR(line->off * line->ny, -0.2, 1e-5);  // of the row beyond, back to the wall
}

TEST(WallLine, WeighsByHits) {
  HitsAround around;
  for (int u = -2; u <= 2; ++u) around.add(static_cast<float>(u), 0.f, 30.f), around.add(static_cast<float>(u), -0.5f, 10.f);
  const auto line = wallLine(around);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->off * line->ny, -0.125, 1e-5);
}

TEST(WallLine, LeavesOutTheOtherFaceOfAThinWall) {
  for (const float thick : {2.f, -2.f}) {  // two cells apart, and the other face was seen a hundred times as often
    HitsAround around;
    for (int u = -2; u <= 2; ++u) around.add(0.f, static_cast<float>(u), 1.f), around.add(thick, static_cast<float>(u), 100.f);
    const auto line = wallLine(around);
    ASSERT_TRUE(line);
    expectNormal(*line, radians(90.0), 1e-5);
    EXPECT_NEAR(line->off, 0.0, 1e-5);
  }
}

TEST(WallLine, NoneOfFewCellsOrAHeap) {
  HitsAround around;
  EXPECT_FALSE(wallLine(around));
  around.add(0.f, 0.f, 5.f);
  EXPECT_FALSE(wallLine(around));
  around.add(1.f, 0.f, 5.f);
  EXPECT_FALSE(wallLine(around));
  HitsAround heap;
  for (int v = -2; v <= 2; ++v)
    for (int u = -2; u <= 2; ++u) heap.add(static_cast<float>(u), static_cast<float>(v), 1.f);
  EXPECT_FALSE(wallLine(heap));
}

TEST(WallLine, DoesNotDependOnTheOrderOfTheCells) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-2.4f, 2.4f);
  for (int round = 0; round < 200; ++round) {
    HitsAround one, other;
    for (int k = 0; k < 9; ++k) one.add(place(random), 0.2f * place(random), static_cast<float>(1 + k));
    for (int k = 8; k >= 0; --k) other.add(one.x[k], one.y[k], one.hits[k]);
    const auto a = wallLine(one), b = wallLine(other);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_NEAR(std::abs(a->nx * b->nx + a->ny * b->ny), 1.f, 1e-4f);
    EXPECT_NEAR(std::abs(a->off), std::abs(b->off), 1e-4f);
  }
}

}  // namespace
}  // namespace field_fusion::core
