// What the quadruped of paper 004 carries, and what its sensors see of the eight obstacles of Fig. 15.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "field_fusion/core/sim/sensor_models.h"

namespace field_fusion::core::sim {
namespace {

const std::string kConfig = PROJECT_DIR "/config/";

World shipped(const std::string& name) { return loadWorld(kConfig + "worlds/" + name + ".yaml"); }

const Mount& mountOf(const World& world, const std::string& name) {
  for (const Mount& mount : world.robot.mounts)
    if (mount.name == name) return mount;
  throw std::runtime_error(world.name + " has no sensor " + name);
}

template <class P>
P paramsOf(const Mount& mount) {
  return std::get<P>(sensorParams(kConfig + "sensors", mount.model, mount.overrides));
}

TEST(QuadWorlds, CarryTheSensorsOfThePaper) {
  for (const char* name : {"quad_corridor", "quad_obstacles", "quad_stack", "quad_lab"}) {
    const World world = shipped(name);
    const Mount &scan = mountOf(world, "scan"), &depth = mountOf(world, "depth");
    EXPECT_EQ(scan.model, "rplidar_a3");
    EXPECT_EQ(paramsOf<Scanner2dParams>(scan).rate, 10.0);
    EXPECT_EQ(depth.model, "d435");
    EXPECT_EQ(paramsOf<DepthCameraParams>(depth).rate, 30.0);
    EXPECT_EQ(paramsOf<ImuParams>(mountOf(world, "imu")).rate, 200.0);
    EXPECT_EQ(paramsOf<LegOdometryParams>(mountOf(world, "odom")).rate, 500.0);
    const Eigen::AlignedBox3d body = world.robot.model.box();
    EXPECT_GT(scan.T_base_sensor.translation().z(), body.max().z());   // above the body
    EXPECT_GT(depth.T_base_sensor.translation().x(), body.max().x());  // at the front
    const Eigen::Vector3d looks = depth.T_base_sensor.linear().col(0);
    EXPECT_NEAR(degrees(std::asin(-looks.z())), 15.0, 1e-9);  // section 5.1: 15 degrees down
    EXPECT_NEAR(looks.y(), 0.0, 1e-12);
  }
}

class EightObstacles : public testing::Test {
 protected:
  PoseAt poseOf(const std::string& mount) const {
    return [way = world_.robot.way, T = mountOf(world_, mount).T_base_sensor](double time) {
      return way.pose(time) * T;
    };
  }
  /// When the base first comes to that x.
  double timeAt(double x) const {
    double t = 0;
    while (world_.robot.way.pose(t).translation().x() < x) t += 0.05;
    return t;
  }
  const std::string& nameOf(int body) const { return world_.bodies[static_cast<std::size_t>(body)].name; }

  World world_ = shipped("quad_obstacles");
  Caster caster_{world_};
};

/// While it trots, its roll and pitch let a beam touch a high chair once in a while.
TEST_F(EightObstacles, TheScannerPassesOverFourOfThem) {
  Scanner2d scanner(paramsOf<Scanner2dParams>(mountOf(world_, "scan")), 1);
  std::map<std::string, double> hits;  // a scan
  const double end = world_.robot.way.duration();
  int scans = 0;
  for (double t = 0; t < end; t += 0.31, ++scans) {
    scanner.scan(caster_, poseOf("scan"), t);
    for (const BeamReturn& beam : scanner.truth())
      if (beam.body >= 0 && std::isfinite(beam.range)) hits[nameOf(beam.body)] += 1.0;
  }
  for (const char* low : {"stool", "chair", "football", "blue_cone"}) EXPECT_LT(hits[low] / scans, 0.5) << low;
  for (const char* high : {"red_cone_on_box", "stacked_boxes", "barrel", "distribution_box"})
    EXPECT_GT(hits[high] / scans, 5.0) << high;
}

/// The camera sees football and box from afar, and no more when the robot is beside them.
TEST_F(EightObstacles, TwoLeaveTheCamerasViewBeforeTheRobotIsThere) {
  DepthCamera camera(paramsOf<DepthCameraParams>(mountOf(world_, "depth")), 1);
  const auto pixels = [&](const std::string& name, double x) {
    camera.frame(caster_, poseOf("depth"), timeAt(x));
    const auto& bodies = camera.truth().bodies;
    return std::count_if(bodies.begin(), bodies.end(),
                         [&](int body) { return body >= 0 && nameOf(body) == name; });
  };
  for (const auto& [name, x] : std::map<std::string, double>{{"football", 0.7}, {"red_cone_on_box", 2.3}}) {
    EXPECT_GT(pixels(name, x - 2.5), 200) << name;
    EXPECT_EQ(pixels(name, x - 0.6), 0) << name;
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
