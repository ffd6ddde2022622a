// A box that a sensor passes: what it could see is known by geometry.
#include "field_fusion/core/sim/seen.h"

#include <gtest/gtest.h>

#include "../../support/sim_worlds.h"
#include "field_fusion/core/sim/shapes.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kCell = 0.1;

/// 1 x 0.9 x 0.5 m, its near face at x = 2.05: no face lies on the border of a cell.
World boxAhead() {
  Body body;
  body.name = "box";
  body.model = makeShape("box", {{"length", 1}, {"width", 0.9}, {"height", 0.5}});
  body.way = Trajectory({{Eigen::Vector3d(2.55, 0.0, 0.0), 0.0, 0.0}}, {});
  return test::worldOf({body});
}

PoseTrack::Pose at(double x, double y, double z, double pitch = 0.0) {
  return {Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(pitch), Eigen::Vector3f::UnitY())),
          Eigen::Vector3d(x, y, z).cast<float>()};
}

SeenCells seen(const World& world, const std::vector<Ray>& rays, const SeenParams& params = {}) {
  Caster caster(world);
  caster.setWindow(0.0, 0.0);
  SeenCells cells;
  addSeen(caster, rays, params, kCell, cells);
  return cells;
}

TEST(Seen, AScannersBeamsEndOnTheNearFaceAlone) {
  Scanner2dParams scanner;
  scanner.field_of_view = 360.0, scanner.angle_step = 0.5;
  const SeenCells cells = seen(boxAhead(), raysOf(scanner, at(0, 0, 0.3)));
  EXPECT_EQ(cells.size(), 10u);
  for (int row = -5; row < 5; ++row) EXPECT_EQ(cells.count({20, row}), 1u) << row;
}

TEST(Seen, AboveItNothing) {
  Scanner2dParams scanner;
  scanner.field_of_view = 360.0, scanner.angle_step = 0.5;
  EXPECT_TRUE(seen(boxAhead(), raysOf(scanner, at(0, 0, 0.6))).empty());
}

TEST(Seen, HeightsAndRangesCountAsAsked) {
  DepthCameraParams camera;  // 62 degrees high: sees face and top from 0.8 m above the ground
  const auto rays = raysOf(camera, at(0, 0, 0.8), 1);  // on the top's far edge from row to row by 0.08 m
  const SeenCells all = seen(boxAhead(), rays);
  EXPECT_EQ(all.size(), 110u);  // x 2.05 to 3.05 lies in 11 columns, y in 10 rows
  SeenParams face;
  face.high = 0.45;
  for (const auto& cell : seen(boxAhead(), rays, face)) EXPECT_EQ(cell.first, 20);
  SeenParams near;
  near.farthest = 2.0;
  EXPECT_TRUE(seen(boxAhead(), rays, near).empty());
  SeenParams far;
  far.nearest = 4.0;
  EXPECT_TRUE(seen(boxAhead(), rays, far).empty());
}

TEST(Seen, GroundIsNoBody) {
  World world = test::worldOf({});
  world.ground.kind = Ground::Kind::kPlane;
  EXPECT_TRUE(seen(world, raysOf(DepthCameraParams(), at(0, 0, 0.5, 0.3), 4)).empty());
}

TEST(Seen, OutlineOfABlockIsItsBorder) {
  TruthGrid slice;
  slice.cell = 0.5, slice.origin = {-1.0, 2.0}, slice.columns = 4, slice.rows = 3;
  slice.occupied = {1, 1, 1, 0,  //
                    1, 1, 1, 0,  //
                    1, 1, 1, 0};
  const SeenCells outline = outlineOf(slice);  // what lies at the slice's own edge counts
  EXPECT_EQ(outline.size(), 8u);
  EXPECT_EQ(outline.count({-1, 5}), 0u);  // the middle
  EXPECT_EQ(outline.count({-2, 4}), 1u);
}

}  // namespace
}  // namespace field_fusion::core::sim
