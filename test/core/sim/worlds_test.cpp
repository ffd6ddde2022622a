// The worlds that the package brings.
#include <gtest/gtest.h>

#include <map>

#include "field_fusion/core/sim/sensor_models.h"
#include "field_fusion/core/sim/truth.h"

namespace field_fusion::core::sim {
namespace {

World shipped(const std::string& name, std::optional<std::uint64_t> seed = {}) {
  return loadWorld(PROJECT_DIR "/config/worlds/" + name + ".yaml", "", seed);
}

/// Whether two boxes, that turn about z alone as far as it matters, come within `gap` of each other.
bool near(const TruthBox& a, const TruthBox& b, double gap) {
  const Eigen::Vector3d apart = b.T_world_box.translation() - a.T_world_box.translation();
  if (std::abs(apart.z()) > (a.size.z() + b.size.z()) / 2) return false;
  for (const TruthBox* box : {&a, &b})
    for (const int axis : {0, 1}) {  // separating axes in the plane
      const Eigen::Vector3d n = box->T_world_box.linear().col(axis);
      double reach = gap;
      for (const TruthBox* of : {&a, &b})
        for (const int side : {0, 1})
          reach += std::abs(of->T_world_box.linear().col(side).dot(n)) * of->size[side] / 2;
      if (std::abs(apart.dot(n)) > reach) return false;
    }
  return true;
}

class Worlds : public testing::TestWithParam<const char*> {
 protected:
  /// As the file says, and with sizes of some runs.
  static std::vector<World> drawn() {
    std::vector<World> worlds{shipped(GetParam())};
    for (const std::uint64_t seed : {1, 2, 3}) worlds.push_back(shipped(GetParam(), seed));
    return worlds;
  }
};

INSTANTIATE_TEST_SUITE_P(Shipped, Worlds,
                         testing::Values("usv_cages", "usv_harbour", "quad_corridor", "quad_obstacles",
                                         "quad_stack", "quad_lab", "office"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Worlds, NothingIsInTheRobotsWay) {
  for (const World& world : drawn()) {
    EXPECT_EQ(world.name, GetParam());
    ASSERT_FALSE(world.robot.mounts.empty());
    World robot;
    robot.bodies.push_back({"robot", "", world.robot.model, world.robot.way, {}});
    const double end = std::max(world.robot.way.duration(), 120.0);
    for (double t = 0; t < end; t += 0.2) {
      const TruthBox own = truthAt(robot, t)[0];
      for (const TruthBox& box : truthAt(world, t))
        ASSERT_FALSE(near(own, box, 0.1))
            << box.name << " at " << t << " s, robot at " << own.T_world_body.translation().transpose();
    }
  }
}

TEST_P(Worlds, BodiesDoNotStandInEachOther) {
  for (const World& world : drawn())
    for (double t = 0; t < 60; t += 1.0) {
      const auto boxes = truthAt(world, t);
      for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (!boxes[i].label.empty() && !boxes[j].label.empty()) {
            ASSERT_FALSE(near(boxes[i], boxes[j], 0.0))
                << boxes[i].name << ", " << boxes[j].name << " at " << t;
          }
    }
}

/// Sizes of the vessel's worlds are drawn; lengths by which a quadruped's maps are measured are not.
TEST_P(Worlds, HaveTheSizesThatTheirPapersFix) {
  const World nominal = shipped(GetParam()), other = shipped(GetParam(), 1);
  const bool spread = std::string(GetParam()).rfind("usv", 0) == 0;
  for (std::size_t i = 0; i < nominal.bodies.size(); ++i) {
    const double ratio = other.bodies[i].size.norm() / nominal.bodies[i].size.norm();
    if (!spread || nominal.bodies[i].label.empty())
      EXPECT_NEAR(ratio, 1.0, 1e-6) << nominal.bodies[i].name;
    else
      EXPECT_TRUE(ratio != 1.0 && std::abs(ratio - 1.0) < 0.1) << nominal.bodies[i].name << " " << ratio;
  }
}

/// Paper 001, section VII-A; the scanner triggers the camera.
TEST(UsvWorlds, CarryTheSensorsOfThePaper) {
  for (const char* name : {"usv_cages", "usv_harbour"}) {
    std::map<std::string, std::string> models;
    std::map<std::string, double> rates;
    for (const Mount& mount : shipped(name).robot.mounts) {
      models[mount.name] = mount.model;
      rates[mount.name] =
          std::visit([](const auto& p) { return p.rate; },
                     sensorParams(PROJECT_DIR "/config/sensors", mount.model, mount.overrides));
    }
    EXPECT_EQ(models["lidar"], "helios16");
    EXPECT_EQ(models["camera"], "xfk_4k415");
    EXPECT_EQ(rates["lidar"], 10.0);
    EXPECT_EQ(rates["camera"], rates["lidar"]);
    if (std::string(name) == "usv_cages") continue;  // it stands on land
    EXPECT_EQ(rates["imu"], 200.0);
    EXPECT_EQ(models["gnss"], "gnss");
  }
}

TEST(UsvCages, StandsWhereTableISays) {
  const World world = shipped("usv_cages");
  struct Position {
    double distance, to_the_right;
  };
  const std::vector<Position> table{{2, 0},  {2, 30}, {3, 0},   {3, 20},  {4, 10},
                                    {4, 20}, {5, 10}, {2, -10}, {3, -10}, {4, -20}};
  const Transform T_lidar_world = (world.robot.way.pose(0) * world.robot.mounts[0].T_base_sensor).inverse();
  std::size_t stand = 0;
  double standing = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Constant(99);
  for (double t = 0; t < world.bodies[0].way.duration(); t += 0.1) {
    const TruthBox cage = truthAt(world, t)[0];
    const Eigen::Vector3d place = T_lidar_world * cage.T_world_box.translation();
    standing = (place - last).norm() < 1e-9 ? standing + 0.1 : 0.0;
    last = place;
    if (std::abs(standing - 9.0) > 0.01) continue;  // once in each pause of 10 s
    ASSERT_LT(stand, table.size());
    const double face = place.head<2>().norm() - cage.size.x() / 2;
    EXPECT_NEAR(face, table[stand].distance, 0.04) << stand;  // the ring is wider than its middle line
    EXPECT_NEAR(degrees(std::atan2(place.y(), place.x())), -table[stand].to_the_right, 0.01) << stand;
    ++stand;
  }
  EXPECT_EQ(stand, table.size());
}

TEST(UsvHarbour, WavesTiltTheVesselByUpToFiveDegrees) {
  const World world = shipped("usv_harbour");
  double steepest = 0.0;
  for (const Wave& wave : world.ground.waves) steepest += 2 * radians(180) / wave.length * wave.amplitude;
  EXPECT_NEAR(degrees(std::atan(steepest)), 4.9, 0.1);
  double tilt = 0.0;
  for (double t = 0; t < 120; t += 0.1)
    tilt = std::max(tilt, std::acos(world.robot.way.pose(t).linear()(2, 2)));
  EXPECT_LT(degrees(tilt), 5.0);
  EXPECT_GT(degrees(tilt), 2.5);
}

TEST(QuadCorridor, IsThirtyMetresLongAndClosed) {
  const World world = shipped("quad_corridor");
  ASSERT_EQ(world.dimensions.size(), 1u);
  EXPECT_NEAR(world.dimensions[0].length(), 30.0, 1e-9);
  const TruthGrid grid = occupancy(world, 0, {0.6, 0.6, 0.05, 0.5});
  for (double y = -1.0; y < 1.0; y += 0.05)
    for (const double x : {-15.0, 15.0})
      EXPECT_TRUE(grid.at(Eigen::Vector2d(x + 0.001, y)) || grid.at(Eigen::Vector2d(x - 0.001, y)));
}

TEST(QuadObstacles, FourOfEightLieBelowTheScanner) {
  const World world = shipped("quad_obstacles");
  const double scanner = world.robot.mounts[0].T_base_sensor.translation().z();
  std::map<std::string, double> tops;
  for (const TruthBox& box : truthAt(world, 0))
    if (!box.label.empty()) tops[box.name] = box.T_world_box.translation().z() + box.size.z() / 2;
  ASSERT_EQ(tops.size(), 8u);
  for (const char* low : {"stool", "chair", "football", "blue_cone"})
    EXPECT_LT(tops[low], scanner - 0.09) << low;
  for (const char* high : {"red_cone_on_box", "stacked_boxes", "barrel", "distribution_box"})
    EXPECT_GT(tops[high], scanner + 0.09) << high;
}

/// A dimension ends on surfaces, seen at its height.
TEST(QuadLab, MarkedDimensionsEndOnWhatStandsThere) {
  const World world = shipped("quad_lab");
  ASSERT_EQ(world.dimensions.size(), 10u);
  const TruthGrid grid = occupancy(world, 0, {0.6, 0.6, 0.02, 0.5});
  const auto touches = [&grid](const Eigen::Vector3d& end) {
    for (double dx = -0.02; dx <= 0.021; dx += 0.02)
      for (double dy = -0.02; dy <= 0.021; dy += 0.02)
        if (grid.at(Eigen::Vector2d(end.head<2>() + Eigen::Vector2d(dx, dy)))) return true;
    return false;
  };
  for (const Dimension& dimension : world.dimensions) {
    if (dimension.name == "d_barrels") continue;  // from middle to middle
    EXPECT_TRUE(touches(dimension.from)) << dimension.name;
    EXPECT_TRUE(touches(dimension.to)) << dimension.name;
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
