#include <gtest/gtest.h>

#include <stdexcept>

#include "world_file.h"

namespace field_fusion::core::sim {
namespace {

const char* const kFull = R"(
ground: {kind: plane, slope_deg: [45, 0]}
light: {sun_azimuth_deg: 90, sun_elevation_deg: 0}
bodies:
  - {name: crate, label: box, shape: box, params: {length: 2}, pose: [3, 1, 90], material: {colour: [1, 0, 0]}}
  - {name: post, shape: cylinder, pose: [0, 5, 0.5, 0], repeat: {count: [2, 2], step: [1, 2]}}
  - name: pair
    parts:
      - {shape: box}
      - {shape: sphere, params: {diameter: 0.5}, at: [0, 0, 1]}
    motion: {points: [[0, -5], {at: [4, -5, 0.25], pause: 2}], speed: 2, loop: true, shake: gait}
robot:
  name: dog
  pose: [0, 0, 0]
  mounts:
    - {name: imu, model: imu_a, gyro_noise: 0.3}
    - {name: scan, model: scan_b, pose: [0.1, 0, 0.5, 0, 90, 0]}
  body: {shape: box, params: {height: 0.4}}
dimensions:
  - {name: d, from: [0, 0, 0], to: [3, 4, 0]}
)";

TEST_F(WorldFile, SaysWhatItSays) {
  const World world = load(kFull);
  EXPECT_EQ(world.name, "w");
  ASSERT_EQ(world.bodies.size(), 6u);
  const Body& crate = world.bodies[0];
  EXPECT_EQ(crate.label, "box");
  EXPECT_TRUE(crate.size.isApprox(Eigen::Vector3d(2, 1, 1), 1e-6));
  EXPECT_TRUE(crate.way.pose(0).translation().isApprox(Eigen::Vector3d(3, 1, 3), 1e-9));  // on the slope
  EXPECT_EQ(crate.model.links[0].parts[0].material.colour, Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(world.bodies[4].name, "post_4");
  EXPECT_TRUE(world.bodies[4].way.pose(0).translation().isApprox(Eigen::Vector3d(1, 7, 1.5), 1e-9));
  EXPECT_NEAR(world.bodies[5].size.z(), 1.5, 1e-6);
  EXPECT_GT(world.bodies[5].way.duration(), 4.0);
  EXPECT_TRUE(world.light.to_sun.isApprox(Eigen::Vector3d(0, 1, 0), 1e-9));
  EXPECT_EQ(world.dimensions.at(0).length(), 5.0);
}

TEST_F(WorldFile, PaintsPartsByWhatTheyAre) {
  const World world = load(R"(
light: {zenith: [0.1, 0.2, 0.3], horizon: [0.4, 0.5, 0.6], sun_colour: [1, 0.5, 0], clouds: 0.25, cloud_size: 2, cloud_seed: 7, visibility: 300}
bodies:
  - name: boat
    shape: boat
    pose: [0, 0]
    material: {colour: [0, 1, 0], wear: 0.5}
    materials: {hull: {colour: [1, 0, 0], texture: dots}, mast: {gloss: 0.7}}
)");
  int hulls = 0;
  for (const Part& part : world.bodies[0].model.links[0].parts) {
    const bool hull = part.role == "hull";
    hulls += hull;
    EXPECT_EQ(part.material.colour, hull ? Eigen::Vector3f(1, 0, 0) : Eigen::Vector3f(0, 1, 0)) << part.role;
    EXPECT_EQ(part.material.texture == Material::Texture::kDots, hull);
    EXPECT_EQ(part.material.wear, 0.5f);
    if (part.role == "mast") {
      EXPECT_EQ(part.material.gloss, 0.7f);
    }
  }
  EXPECT_EQ(hulls, 1);
  const Light& light = world.light;
  EXPECT_EQ(light.zenith, Eigen::Vector3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(light.horizon, Eigen::Vector3f(0.4f, 0.5f, 0.6f));
  EXPECT_EQ(light.sun_colour, Eigen::Vector3f(1.f, 0.5f, 0.f));
  EXPECT_EQ(light.clouds, 0.25);
  EXPECT_EQ(light.cloud_size, 2.0);
  EXPECT_EQ(light.cloud_seed, 7u);
  EXPECT_EQ(light.visibility, 300.0);
}

TEST_F(WorldFile, RobotHasItsMounts) {
  const Robot robot = load(kFull).robot;
  EXPECT_EQ(robot.name, "dog");
  ASSERT_EQ(robot.mounts.size(), 2u);
  EXPECT_EQ(robot.mounts[0].overrides.at("gyro_noise"), "0.3");
  const Transform& T = robot.mounts[1].T_base_sensor;  // pitched by 90 degrees: looks down
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(robot.model.box().max().z(), 0.4, 1e-6);
}

TEST_F(WorldFile, BodiesFloatOnWater) {
  const World world = load(R"(
ground: {kind: water, waves: [{amplitude: 0.5, length: 30}]}
bodies:
  - {name: buoy, shape: box, pose: [0, 0, -0.25, 0], floats: true}
  - {name: pile, shape: box, pose: [0, 9, 0]}
)");
  EXPECT_NEAR(world.bodies[0].way.pose(0).translation().z(), 0.25, 0.01);  // a crest
  EXPECT_FALSE(world.bodies[0].way.still());
  EXPECT_TRUE(world.bodies[1].way.still());
  EXPECT_EQ(world.bodies[1].way.pose(0).translation().z(), 0.0);
}

/// Largest tilt of a robot that stands, or goes at a steady `speed`, in two seconds.
double tilt(const World& world, double begin) {
  double most = 0.0;
  for (double t = begin; t < begin + 2; t += 0.01)
    most = std::max(most, degrees(std::acos(std::min(1.0, world.robot.way.pose(t).linear()(2, 2)))));
  return most;
}

TEST_F(WorldFile, StepsAndRoadsShakeWhatMovesAndWavesWhatStandsToo) {
  const auto standing = [this](const std::string& shake) {
    return tilt(load("robot: {pose: [0, 0], motion: {shake: " + shake + "}}\n"), 0.0);
  };
  const auto going = [this](const std::string& shake, const std::string& speed) {
    return tilt(load("robot: {motion: {points: [[0, 0], [99, 0]], acceleration: 5, speed: " + speed +
                     ", shake: " + shake + "}}\n"),
                5.0);
  };
  EXPECT_EQ(standing("gait"), 0.0);
  EXPECT_EQ(standing("road"), 0.0);
  EXPECT_GT(standing("waves"), 2.0);
  EXPECT_GT(going("gait", "0.5"), 1.5);
  EXPECT_NEAR(going("gait", "0.5"), going("gait", "2"), 1e-6);
  EXPECT_NEAR(going("road", "1.5"), going("road", "3") / 2, 1e-3);  // half of its full speed
  EXPECT_NEAR(going("{preset: gait, scale: 2}", "1"), 2 * going("gait", "1"), 1e-3);
  EXPECT_EQ(tilt(load("robot: {pose: [0, 0], motion: {shake: {preset: waves, full_speed: 1}}}\n"), 0.0), 0.0);
}

class WorldFileFault : public WorldFile, public testing::WithParamInterface<Fault> {};

TEST_P(WorldFileFault, IsNamedWithLineAndKey) { EXPECT_EQ(fault(GetParam().text), GetParam().says); }

const char* const kRobot = "robot: {pose: [0, 0], mounts: [{name: a, model: imu_a}]}\n";

INSTANTIATE_TEST_SUITE_P(
    Bodies, WorldFileFault,
    testing::Values(
        Fault{"name: a\nbodys: []\n", "2: bodys: unknown key (did you mean bodies?)"},
        Fault{"name: a\nname: b\n", "2: name is there twice"},
        Fault{"light: {zenith: [0, 0, 0]}\n",
              "1: light.zenith: must be [red, green, blue] of 0..1, not black"},
        Fault{"bodies:\n - {name: a, shape: stool, pose: [0, 0],\n    materials: {hull: {gloss: 1}}}\n",
              "3: bodies[0].materials.hull: no part is that; there are: seat leg"},
        Fault{"bodies:\n - {name: a, shape: bxo, pose: [0, 0]}\n",
              "2: bodies[0].shape: no shape is named bxo (did you mean box?)"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0],\n    params: {lenght: 1}}\n",
              "3: bodies[0].params.lenght: unknown key (did you mean length?)"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0]}\n",
              "2: bodies[0].pose: must be a list of 2 to 4 numbers"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, left]}\n",
              "2: bodies[0].pose[1]: must be a number"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, .nan]}\n", "2: bodies[0].pose[1]: must be finite"},
        Fault{"bodies:\n - {name: a, pose: [0, 0]}\n", "2: bodies[0]: needs one of shape, mesh and parts"},
        Fault{"bodies:\n - {name: a, shape: box}\n", "2: bodies[0]: needs pose, or motion with points"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0]}\n - {name: a, shape: box, pose: [9, 0]}\n",
              "3: bodies[1]: two bodies are named a"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0], floats: true}\n",
              "2: bodies[0].floats: the ground is no water"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0], material: {gloss: 2}}\n",
              "2: bodies[0].material.gloss: 2 is outside [0, 1]"},
        Fault{"bodies:\n - name: a\n   shape: box\n   motion: {points: [[0, 0], [1, 0], [1, 0]]}\n",
              "4: bodies[0].motion.points: way-point 3 is at the place of the one before it and does not "
              "differ in yaw"},
        Fault{"bodies:\n - name: a\n   shape: box\n   motion: {points: [[0, 0], [1, 0]], speed: 0}\n",
              "4: bodies[0].motion.speed: 0 must be above 0"},
        Fault{"bodies: {}\n", "1: bodies: must be a list"}));

INSTANTIATE_TEST_SUITE_P(
    Rest, WorldFileFault,
    testing::Values(
        Fault{"ground: {kind: plane, waves: []}\n", "1: ground.waves: unknown key"},
        Fault{"ground: {kind: lava}\n", "1: ground.kind: 'lava' is none of none, plane, rough, water"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, rate: 0}]}\n",
              "1: robot.mounts[0].rate: 0 must be above 0"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, gyro_nose: 1}]}\n",
              "1: robot.mounts[0].gyro_nose: no parameter of imu_a (did you mean gyro_noise?)"},
        Fault{"robot:\n pose: [0, 0]\n mounts:\n  - {name: a, model: imu_a}\n  - {name: a, model: scan_b}\n",
              "5: robot.mounts[1]: two sensors are named a"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: my imu, model: imu_a}]}\n",
              "1: robot.mounts[0].name: 'my imu' must be a letter, then letters, digits and _"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: 3a, model: imu_a}]}\n",
              "1: robot.mounts[0].name: '3a' must be a letter, then letters, digits and _"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: base, model: imu_a}]}\n",
              "1: robot.mounts[0].name: 'base' is taken"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, pose: [0, 0]}]}\n",
              "1: robot.mounts[0].pose: must be a list of 3 to 6 numbers"},
        Fault{
            "bodies:\n - {name: wall, shape: box, pose: [1, 0]}\nrobot: {pose: [0, 0],\n  mounts: [{name: a, "
            "model: imu_a, pose: [0.7, 0, 0.5]}]}\n",
            "4: robot.mounts[0]: the sensor a is inside the body wall at the start"},
        Fault{"bodies:\n - {name: wall, shape: sphere, pose: [0, 0, -0.3, 0]}\nrobot: {pose: [0, 0]}\n",
              "3: robot: the robot is inside the body wall at the start"},
        // 1.52 m away: 1 m in 2 s with 0.5 m/s^2, the rest at 1 m/s
        Fault{"bodies:\n - {name: wall, shape: box, pose: [2.02, 0]}\n"
              "robot: {motion: {points: [[0, 0], [5, 0]], speed: 1, acceleration: 0.5}}\n",
              "3: robot: the robot is inside the body wall after 2.55 s"},
        // a gate comes from 3.98 m aside: after 2 s it is 1.98 m away, after 3 s 0.48 m, and reaches 0.5 m around it
        Fault{"bodies:\n - {name: gate, shape: box, motion: {points: [[4, 3.98], [4, -0.02]], speed: 2, acceleration: 1}}\n"
              "robot: {motion: {points: [[0, 0], [10, 0]], speed: 2, acceleration: 1}}\n",
              "3: robot: the robot is inside the body gate after 3 s"},
        Fault{
            "ground: {kind: rough, half_extent: 20}\nrobot: {motion: {points: [[0, 0], [19, 0], [25, 0]]}}\n",
            "2: robot.motion.points: leaves the ground, which ends 20 m from the origin"},
        Fault{"robot: {pose: [0, 0], motion: {points: [[1, 1]]}}\n",
              "1: robot.motion.points: has the place in pose too"},
        Fault{"size_spread: 0.9\n", "1: size_spread: 0.9 is outside [0, 0.5]"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, mount_error: {angle: 1}}]}\n",
              "1: robot.mounts[0].mount_error.angle: unknown key"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, clock_error: -1}]}\n",
              "1: robot.mounts[0].clock_error: -1 is outside [0, 1]"},
        Fault{"robot: {pose: [0, 0], motion: {shake: sea}}\n",
              "1: robot.motion.shake: 'sea' is none of gait, waves, road"},
        Fault{"dimensions: [{name: d, from: [0, 0, 0], to: [0, 0, 0]}]\n",
              "1: dimensions[0]: both ends are at one place"},
        Fault{"name: [a\n", "2: end of sequence flow not found"}));

TEST_F(WorldFile, MissingMeshAndNegativeSizeAreNamed) {
  const std::string mesh = fault("bodies:\n - {name: a, mesh: hull.obj, pose: [0, 0]}\n");
  EXPECT_EQ(mesh.rfind("2: bodies[0].mesh: ", 0), 0u) << mesh;
  EXPECT_NE(mesh.find("hull.obj"), std::string::npos) << mesh;
  const std::string size = fault("bodies:\n - {name: a, shape: box, pose: [0, 0], params: {width: -1}}\n");
  EXPECT_EQ(size.rfind("2: bodies[0].params: ", 0), 0u) << size;
  EXPECT_NE(size.find("width"), std::string::npos) << size;
}

TEST_F(WorldFile, AnUnknownSensorIsNamedWithTheNearest) {
  const std::string says = fault("robot: {pose: [0, 0], mounts: [{name: a, model: imu_b}]}\n");
  EXPECT_EQ(says.rfind("1: robot.mounts[0].model: no sensor imu_b in ", 0), 0u) << says;
  EXPECT_NE(says.find("(did you mean imu_a?)"), std::string::npos) << says;
}

TEST_F(WorldFile, AnOverrideOutOfRangeOrOfAnotherTypeIsNamed) {
  for (const char* value : {"-1.0", "much"}) {
    const std::string mount = std::string("{name: a, model: imu_a, gyro_noise: ") + value + "}";
    std::string says;
    try {
      load("robot: {pose: [0, 0], mounts: [" + mount + "]}\n");
    } catch (const std::runtime_error& fault) {
      says = fault.what();
    }
    EXPECT_NE(says.find("w.yaml:1: robot.mounts[0]: "), std::string::npos) << says;
    EXPECT_NE(says.find("gyro_noise"), std::string::npos) << says;
  }
}

TEST_F(WorldFile, ARobotAmongBodiesButInNoneIsFree) {
  EXPECT_EQ(fault(std::string("bodies:\n - {name: wall, shape: box, pose: [0.6, 0]}\n") + kRobot), "");
}

TEST_F(WorldFile, AFileThatIsNotThereIsNamed) {
  try {
    loadWorld("/nowhere/at_all.yaml");
    FAIL();
  } catch (const std::runtime_error& fault) {
    EXPECT_STREQ(fault.what(), "/nowhere/at_all.yaml: cannot be read");
  }
}

}  // namespace
}  // namespace field_fusion::core::sim
