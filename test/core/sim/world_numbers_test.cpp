// Numbers of a world file that are beyond sense.
#include "world_file.h"

namespace field_fusion::core::sim {
namespace {

class WorldNumbers : public WorldFile, public testing::WithParamInterface<Fault> {};

TEST_P(WorldNumbers, AreRefusedWithLineAndKey) { EXPECT_EQ(fault(GetParam().text), GetParam().says); }

INSTANTIATE_TEST_SUITE_P(
    Odd, WorldNumbers,
    testing::Values(
        Fault{"", "1: must be a table"}, Fault{"# nothing\n", "1: must be a table"},
        Fault{"robot: {pose: [0, 0],\n mounts: [{name: a, model: scan_b, pose: [0, 0, -0.5]}]}\n",
              "2: robot.mounts[0]: the sensor a is below the ground at the start"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, pose: [0, 0, -0.5]}]}\n", ""},
        Fault{"robot: {pose: [0, 0], body: {shape: box},\n mounts: [{name: a, model: scan_b, pose: [0, 0, 0.5]}]}\n",
              "2: robot.mounts[0]: the sensor a is inside the robot's own body"},
        Fault{"ground: {kind: water, waves: [{amplitude: 50, length: 1}]}\n",
              "1: ground.waves[0].amplitude: 50 breaks: at a length of 1 it must not be above 0.0706"},
        Fault{"ground: {kind: water, waves: [{amplitude: 0.07, length: 1}]}\n", ""},
        Fault{"ground:\n  kind: water\n  waves: [{amplitude: 0.05, length: 1}, {amplitude: 0.05, length: 1}]\n",
              "3: ground.waves: break: their amplitudes over their lengths add up to 0.1, which must not be above "
              "0.0706"},
        Fault{"ground: {kind: water, waves: [{amplitude: 0, length: 1.0e+300}]}\n",
              "1: ground.waves[0].length: 1e+300 is outside [0.01, 10000]"},
        Fault{"ground:\n kind: rough\n half_extent: 1.0e+7\n grain: 0.01\n",
              "3: ground.half_extent: 10000000 is outside [0.1, 10000]"},
        Fault{"ground:\n kind: rough\n half_extent: 97\n grain: 1\n",
              "4: ground.grain: a half_extent of 97 is more than 96 grains of 1"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0], repeat: {count: [1, 2], step: [0, 0]}}\n",
              "2: bodies[0].repeat.step[1]: must not be 0: the bodies would stand in each other"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0], repeat: {count: [1, 1], step: [0, 0]}}\n", ""},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0], repeat: {count: [300, 300], step: [1, 1]}}\n",
              "2: bodies[0]: there are more than 65534 bodies"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0]}\n - {name: b, shape: box, pose: [999, 999]}\n",
              "3: bodies[1]: the bodies spread over more than 0.2 km^2, too much for a map"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 1.0e+30]}\n",
              "2: bodies[0].pose[1]: 1e+30 is outside [-10000, 10000]"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0, 1.0e+30]}\n",
              "2: bodies[0].pose[2]: 1e+30 is outside [-3600, 3600]"},
        Fault{"bodies:\n - {name: a, shape: box, pose: [0, 0],\n    params: {length: 1.0e+300}}\n",
              "3: bodies[0].params: box: length must be 0.000001 to 1000"},
        Fault{"bodies:\n - {name: a, shape: fence, pose: [0, 0], params: {gap: 0.0001}}\n",
              "2: bodies[0].params: gap must leave at most 10000 pieces"},
        Fault{"bodies:\n - {name: a, shape: stacked_boxes, pose: [0, 0], params: {count: 0.5}}\n",
              "2: bodies[0].params: count must be at least 1"},
        Fault{"robot: {motion: {points: [[0, 0], [2, 0]], speed: 1.0e-300}}\n",
              "1: robot.motion.speed: 1e-300 is outside [0.001, 1000]"},
        Fault{"robot: {pose: [0, 0], mounts: [{name: a, model: imu_a, pose: [0, 0, 1.0e+30]}]}\n",
              "1: robot.mounts[0].pose[2]: 1e+30 is outside [-10000, 10000]"}));

}  // namespace
}  // namespace field_fusion::core::sim
