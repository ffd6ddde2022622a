// What a user of the robot does not know is drawn from the seed: sizes of bodies, mounts and clocks of sensors.
#include <gtest/gtest.h>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/truth.h"
#include "support/sim_worlds.h"
#include "support/temp_folder.h"

namespace field_fusion::core::sim {
namespace {

class Drawn : public testing::Test {
 protected:
  Drawn() {
    ImuParams imu;
    folder_.write("sensors/imu_a.yaml", "kind: imu\n" + toYaml(declarationOf(imu)));
  }
  World load(const std::string& text, std::optional<std::uint64_t> seed) const {
    return loadWorld(folder_.write("worlds/w.yaml", text).string(), "", seed);
  }
  test::TempFolder folder_;
};

const char* const kBodies = R"(
size_spread: 0.1
ground: {kind: water}
bodies:
  - {name: wall, shape: box, pose: [0, 0]}
  - {name: crate, label: box, shape: box, params: {length: 2}, pose: [3, 1, 0.5, 90]}
  - {name: fixed, label: box, shape: box, pose: [6, 0], size_spread: 0}
  - {name: buoy, label: buoy, shape: buoy, params: {diameter: 1, height: 2, draught: 0.5}, pose: [9, 0], floats: true}
  - {name: cage, label: cage, shape: cage, params: {diameter: 2, height: 1, draught: 0.4}, pose: [0, 9, 0.4, 0]}
  - {name: ball, label: ball, shape: sphere, params: {diameter: 1}, pose: [0, 20], repeat: {count: [1, 400], step: [0, 2]}}
)";

TEST_F(Drawn, WithoutASeedAllIsAsTheFileSays) {
  const World world = load(kBodies, {});
  EXPECT_TRUE(world.bodies[1].size.isApprox(Eigen::Vector3d(2, 1, 1), 1e-6));
  EXPECT_TRUE(world.bodies.back().size.isApprox(Eigen::Vector3d(1, 1, 1), 1e-6));
}

TEST_F(Drawn, SizesOfLabelledBodiesAreEvenlySpreadWithinTheirLimit) {
  const World world = load(kBodies, 7);
  EXPECT_TRUE(world.bodies[0].size.isApprox(Eigen::Vector3d(1, 1, 1), 1e-6));  // part of the surroundings
  EXPECT_TRUE(world.bodies[2].size.isApprox(Eigen::Vector3d(1, 1, 1), 1e-6));
  const Eigen::Vector3d& crate = world.bodies[1].size;
  EXPECT_NE(crate.x(), 2.0);
  EXPECT_TRUE(crate.isApprox(crate.x() / 2 * Eigen::Vector3d(2, 1, 1), 1e-6));  // alike in all directions
  std::vector<double> sizes;
  for (std::size_t i = 5; i < world.bodies.size(); ++i) sizes.push_back(world.bodies[i].size.x());
  ASSERT_EQ(sizes.size(), 400u);
  for (const double size : sizes) EXPECT_LE(std::abs(size - 1.0), 0.1 + 1e-6);
  const auto spread = test::spreadOf(sizes);  // of an even spread: 0.1 / sqrt(3); bounds of four sigma
  EXPECT_NEAR(spread.mean, 1.0, 4 * 0.0577 / 20);
  EXPECT_NEAR(spread.sigma, 0.0577, 4 * 0.0577 / 20);
}

TEST_F(Drawn, TheSameSeedIsTheSameWorldAndAnotherIsNot) {
  const World a = load(kBodies, 7), b = load(kBodies, 7), c = load(kBodies, 8);
  EXPECT_EQ(a.bodies[1].size, b.bodies[1].size);
  EXPECT_NE(a.bodies[1].size, c.bodies[1].size);
}

TEST_F(Drawn, ABodyMoreChangesNoOther) {
  const World a = load(kBodies, 7);
  const World b = load(std::string(kBodies) + "  - {name: more, label: box, shape: box, pose: [0, -9]}\n", 7);
  for (std::size_t i = 0; i < a.bodies.size(); ++i) EXPECT_EQ(a.bodies[i].size, b.bodies[i].size);
}

TEST_F(Drawn, BodiesStandAndFloatAsBefore) {
  const World nominal = load(kBodies, {});
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto boxes = truthAt(load(kBodies, seed), 0.0), before = truthAt(nominal, 0.0);
    const auto bottom = [](const TruthBox& box) { return box.T_world_box.translation().z() - box.size.z() / 2; };
    for (const std::size_t stands : {1, 4}) EXPECT_NEAR(bottom(boxes[stands]), bottom(before[stands]), 1e-6);
    EXPECT_NEAR(bottom(boxes[3]), -0.5 * boxes[3].size.x(), 1e-6);  // its draught grows as it does
    for (std::size_t i = 0; i < boxes.size(); ++i)
      EXPECT_TRUE(boxes[i].T_world_body.isApprox(before[i].T_world_body)) << boxes[i].name;
  }
}

/// A walker's feet must tread as fast as it walks, however tall it is.
TEST_F(Drawn, ATallWalkersFeetTreadAsFast) {
  const char* const text =
      "bodies: [{name: p, label: person, shape: person, params: {speed: 1.2}, pose: [0, 0],\n"
      "  size_spread: 0.2}]\n";
  const auto fastest = [](const World& world) {
    double most = 0.0;
    const Model& model = world.bodies[0].model;
    for (std::size_t link = 0; link < model.links.size(); ++link)
      for (double t = 0; t < 3; t += 1e-2) {
        const Eigen::Vector3d at(0, 0, 0);  // of the link's frame at rest: the ground below the walker
        const auto place = [&](double time) { return model.linkPose(link, time) * at; };
        most = std::max(most, (place(t + 1e-4) - place(t)).norm() / 1e-4);
      }
    return most;
  };
  const World usual = load(text, {}), other = load(text, 3);
  ASSERT_GT(fastest(usual), 1.0);
  ASSERT_GT(std::abs(other.bodies[0].size.z() / usual.bodies[0].size.z() - 1), 0.02);
  EXPECT_NEAR(fastest(other), fastest(usual), 0.01 * fastest(usual));
}

const char* const kRobot = R"(
robot:
  pose: [0, 0, 0]
  mounts:
    - {name: usual, model: imu_a, pose: [0.1, 0.2, 0.5, 10, 20, 30]}
    - {name: sure, model: imu_a, mount_error: {angle_deg: 0, place: 0}, clock_error: 0}
    - {name: loose, model: imu_a, mount_error: {angle_deg: 5}, clock_error: 0.5}
)";

TEST_F(Drawn, MountsAreOffByNoMoreThanTheirLimits) {
  double most_angle = 0.0, most_place = 0.0, most_loose = 0.0, most_clock = 0.0, most_loose_clock = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto mounts = load(kRobot, seed).robot.mounts;
    const auto error = [&](int i) {
      return Transform(mounts[i].T_base_nominal.inverse() * mounts[i].T_base_sensor);
    };
    // of small angles about three axes the matrix off its diagonal is each angle
    most_angle = std::max(most_angle, (error(0).linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff());
    most_place = std::max(most_place, error(0).translation().cwiseAbs().maxCoeff());
    most_loose = std::max(most_loose, Eigen::AngleAxisd(Eigen::Matrix3d(error(2).linear())).angle());
    most_clock = std::max(most_clock, std::abs(mounts[0].clock_error));
    most_loose_clock = std::max(most_loose_clock, std::abs(mounts[2].clock_error));
    EXPECT_TRUE(error(1).isApprox(Transform::Identity(), 1e-12));
    EXPECT_EQ(mounts[1].clock_error, 0.0);
    EXPECT_LE(error(2).translation().cwiseAbs().maxCoeff(), 0.005);
  }
  EXPECT_LE(most_angle, radians(0.2) * 1.01);
  EXPECT_GT(most_angle, radians(0.19));
  EXPECT_LE(most_place, 0.005);
  EXPECT_GT(most_place, 0.0049);
  EXPECT_GT(degrees(most_loose), 5.0);  // three axes together
  EXPECT_LE(degrees(most_loose), 5.0 * std::sqrt(3.0) * 1.01);
  EXPECT_LE(most_clock, 0.002);
  EXPECT_GT(most_clock, 0.0019);
  EXPECT_LE(most_loose_clock, 0.5);
  EXPECT_GT(most_loose_clock, 0.45);
}

TEST_F(Drawn, MountsAreTrueWithoutASeedAndToldWithOne) {
  const World nominal = load(kRobot, {}), drawn = load(kRobot, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Mount &a = nominal.robot.mounts[i], &b = drawn.robot.mounts[i];
    EXPECT_TRUE(a.T_base_sensor.isApprox(a.T_base_nominal, 1e-12));
    EXPECT_TRUE(a.T_base_nominal.isApprox(b.T_base_nominal, 1e-15));
    EXPECT_EQ(a.clock_error, 0.0);
  }
  EXPECT_FALSE(drawn.robot.mounts[0].T_base_sensor.isApprox(drawn.robot.mounts[0].T_base_nominal, 1e-6));
  EXPECT_NE(drawn.robot.mounts[0].clock_error, drawn.robot.mounts[2].clock_error);
}

}  // namespace
}  // namespace field_fusion::core::sim
