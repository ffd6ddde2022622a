#include "field_fusion/core/sim/truth.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "field_fusion/core/sim/shapes.h"

namespace field_fusion::core::sim {
namespace {

Body body(const std::string& shape, const ShapeParams& params, const Eigen::Vector3d& place, double yaw = 0) {
  Body out;
  out.name = out.label = shape;
  out.model = makeShape(shape, params);
  out.way = Trajectory({{place, yaw, 0.0}}, {});
  return out;
}

int count(const TruthGrid& grid) {
  int n = 0;
  for (const auto cell : grid.occupied) n += cell;
  return n;
}

TEST(SimTruth, BoxesAreWhereTheBodiesAre) {
  World world;
  world.bodies.push_back(body("box", {{"length", 2}, {"width", 1}, {"height", 3}}, {4, 5, 0.5}, radians(90)));
  const auto boxes = truthAt(world, 7.0);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].name, "box");
  EXPECT_TRUE(boxes[0].size.isApprox(Eigen::Vector3d(2, 1, 3), 1e-6));
  EXPECT_TRUE(boxes[0].T_world_box.translation().isApprox(Eigen::Vector3d(4, 5, 2), 1e-6));
  EXPECT_TRUE(boxes[0].T_world_box.linear().col(0).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(SimTruth, ASliceOfABoxIsItsOutline) {
  World world;
  world.bodies.push_back(body("box", {{"length", 2}, {"width", 1}, {"height", 1}}, {0.005, 0.005, 0}));
  SliceParams slice;
  slice.low = slice.high = 0.5;
  slice.cell = 0.1;
  const TruthGrid grid = occupancy(world, 0, slice);
  EXPECT_TRUE(grid.at(Eigen::Vector2d(1.003, 0.3)));
  EXPECT_TRUE(grid.at(Eigen::Vector2d(-0.997, 0.3)));
  EXPECT_TRUE(grid.at(Eigen::Vector2d(0.3, 0.503)));
  EXPECT_FALSE(grid.at(Eigen::Vector2d(0, 0)));  // no surface inside
  EXPECT_FALSE(grid.at(Eigen::Vector2d(1.2, 0.3)));
  EXPECT_FALSE(grid.at(Eigen::Vector2d(99, 0)));
  for (const double dx : {-1.0, 1.0})
    for (const double dy : {-0.5, 0.5}) EXPECT_TRUE(grid.at(Eigen::Vector2d(0.005 + dx, 0.005 + dy)));
}

TEST(SimTruth, ASliceAboveOrBelowIsEmpty) {
  World world;
  world.bodies.push_back(body("box", {}, {0, 0, 0}));
  SliceParams slice;
  slice.low = slice.high = 1.2;
  EXPECT_EQ(count(occupancy(world, 0, slice)), 0);
  slice.low = 0.9;  // the top lies in it: all of it is a surface
  EXPECT_TRUE(occupancy(world, 0, slice).at(Eigen::Vector2d(0, 0)));
}

TEST(SimTruth, RoundOutlinesHaveTheirRadiusAtTheHeight) {
  World world;
  world.bodies.push_back(body("sphere", {{"diameter", 2}}, {0, 0, 0}));  // its middle is 1 m high
  world.bodies.push_back(body("cylinder", {{"diameter", 1}}, {4, 0, 0}));
  SliceParams slice;
  slice.low = slice.high = 1.6;
  slice.cell = 0.02;
  const auto radiusAt = [&](const TruthGrid& grid, double x) {
    double r = 0.0;
    while (r < 3 && !grid.at(Eigen::Vector2d(x, r))) r += 0.001;
    return r;
  };
  EXPECT_NEAR(radiusAt(occupancy(world, 0, slice), 0.0), 0.8, 0.025);  // sqrt(1 - 0.6^2)
  slice.low = slice.high = 0.5;
  EXPECT_NEAR(radiusAt(occupancy(world, 0, slice), 4.0), 0.5, 0.025);
}

TEST(SimTruth, MovingBodiesMove) {
  World world;
  world.bodies.push_back(body("box", {}, {0, 0, 0}));
  world.bodies[0].way = Trajectory({{{0, 0, 0}, kNaN, 0.0}, {{10, 0, 0}, kNaN, 0.0}}, {});
  const auto x = [&](double time) { return truthAt(world, time)[0].T_world_box.translation().x(); };
  EXPECT_NEAR(x(0), 0.0, 1e-9);
  EXPECT_NEAR(x(1), 0.25, 1e-9);  // 0.5 m/s^2
  EXPECT_NEAR(x(99), 10.0, 1e-9);
  EXPECT_FALSE(occupancy(world, 99, {}).at(Eigen::Vector2d(0.5, 0)));
  EXPECT_TRUE(occupancy(world, 99, {}).at(Eigen::Vector2d(10.5, 0)));
}

TEST(SimTruth, NothingIsAnEmptyGridAndNonsenseIsRefused) {
  EXPECT_EQ(occupancy(World(), 0, {}).columns, 0);
  World world;
  world.bodies.push_back(body("box", {}, {0, 0, 0}));
  EXPECT_THROW(occupancy(world, 0, {0.5, 0.4, 0.05, 0.5}), std::invalid_argument);
  EXPECT_THROW(occupancy(world, 0, {0.5, 0.5, 0.0, 0.5}), std::invalid_argument);
  EXPECT_THROW(occupancy(world, 0, {0.5, 0.5, 1e-6, 0.5}), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
