#include "field_fusion/core/sim/urdf.h"

#include <gtest/gtest.h>

#include <regex>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/sim/camera_params.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/shapes.h"
#include "support/temp_folder.h"

namespace field_fusion::core::sim {
namespace {

class Urdf : public testing::Test {
 protected:
  Urdf() {
    world_.robot.name = "dog & <friend>";
    sensor<ImuParams>("imu");
    sensor<CameraParams>("camera");
    sensor<LegOdometryParams>("leg_odometry");
  }
  template <class P>
  void sensor(const std::string& kind) {
    P params;
    folder_.write(kind + ".yaml", "kind: " + kind + "\n" + toYaml(declarationOf(params)));
  }
  void mount(const std::string& name, const std::string& model, const Transform& T) {
    Mount mount;
    mount.name = name, mount.model = model, mount.T_base_nominal = T;
    mount.T_base_sensor = T * Eigen::Translation3d(1, 1, 1);  // no one is told
    world_.robot.mounts.push_back(mount);
  }
  std::string text() const { return urdf(world_, folder_.path().string()); }
  /// The numbers of all places where `pattern` stands, its first group.
  std::vector<double> numbers(const std::string& pattern) const {
    std::vector<double> out;
    std::smatch found;
    const std::string all = text();
    for (auto at = all.cbegin(); std::regex_search(at, all.cend(), found, std::regex(pattern)); at = found[0].second) {
      std::istringstream words(found[1]);
      for (double value; words >> value;) out.push_back(value);
    }
    return out;
  }
  /// As URDF says: about fixed axes x, y, z in turn.
  static Transform placed(const std::vector<double>& xyz, const std::vector<double>& rpy) {
    Transform T(Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()));
    T.translation() = Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
    return T;
  }

  World world_;
  test::TempFolder folder_;
};

TEST_F(Urdf, OfARobotWithNothingIsItsBase) {
  EXPECT_EQ(text(),
            "<?xml version=\"1.0\"?>\n<robot name=\"dog &amp; &lt;friend&gt;\">\n  <link name=\"base\">\n"
            "  </link>\n</robot>\n");
}

TEST_F(Urdf, TellsWhereSensorsAreSaidToBeHoweverTheyAreTurned) {
  std::vector<Transform> turned{Transform::Identity()};
  for (const double pitch : {0.3, -1.2, radians(90), radians(-90), radians(180)})
    for (const double yaw : {0.0, 2.5})
      turned.push_back(Eigen::Translation3d(0.1, -0.2, 1e-3) *
                       Transform(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                 Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX())));
  for (const Transform& T : turned) {
    world_.robot.mounts.clear();
    mount("a", "imu", T);
    const auto xyz = numbers("origin xyz=\"([^\"]*)\""), rpy = numbers("rpy=\"([^\"]*)\"");
    ASSERT_EQ(xyz.size() + rpy.size(), 6u);
    EXPECT_TRUE(placed(xyz, rpy).isApprox(T, 1e-9)) << T.matrix();
  }
}

TEST_F(Urdf, CamerasHaveAnOpticalFrameAndOdometryHasNone) {
  mount("eye", "camera", Transform::Identity());
  mount("odom", "leg_odometry", Transform::Identity());
  EXPECT_NE(text().find("<parent link=\"base\"/><child link=\"eye\"/>"), std::string::npos);
  EXPECT_NE(text().find("<parent link=\"eye\"/><child link=\"eye_optical\"/>"), std::string::npos);
  EXPECT_EQ(text().find("odom"), std::string::npos);
  const auto rpy = numbers("rpy=\"([^\"]*)\"");  // REP 103: z ahead, x to the right
  const Eigen::Matrix3d R = placed({0, 0, 0}, {rpy[3], rpy[4], rpy[5]}).linear();
  EXPECT_TRUE(R.col(2).isApprox(Eigen::Vector3d::UnitX(), 1e-9));
  EXPECT_TRUE(R.col(0).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST_F(Urdf, DrawsBoxesBallsAndCylindersAsTheyAre) {
  world_.robot.model = makeShape("box", {{"length", 2}, {"width", 3}, {"height", 4}});
  EXPECT_EQ(numbers("box size=\"([^\"]*)\""), (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(numbers("origin xyz=\"([^\"]*)\""), (std::vector<double>{0, 0, 2}));
  world_.robot.model = makeShape("sphere", {{"diameter", 2}});
  EXPECT_EQ(numbers("sphere radius=\"([^\"]*)\""), (std::vector<double>{1}));
  world_.robot.model = makeShape("cylinder", {{"diameter", 2}, {"height", 3}});
  EXPECT_EQ(numbers("cylinder radius=\"([^\"]*)\""), (std::vector<double>{1}));
  EXPECT_EQ(numbers("length=\"([^\"]*)\""), (std::vector<double>{3}));
  EXPECT_EQ(numbers("origin xyz=\"([^\"]*)\""), (std::vector<double>{0, 0, 1.5}));
}

TEST_F(Urdf, ATurnedBoxStaysABox) {
  world_.robot.model = makeShape("box", {{"length", 2}, {"width", 3}, {"height", 4}});
  const Eigen::AngleAxisf turn(0.4f, Eigen::Vector3f(1, 2, 3).normalized());
  for (Eigen::Vector3f& vertex : std::get<Mesh>(world_.robot.model.links[0].parts[0].shape).vertices)
    vertex = turn * vertex;
  EXPECT_EQ(numbers("box size=\"([^\"]*)\""), (std::vector<double>{2, 3, 4}));
  const Transform T = placed(numbers("origin xyz=\"([^\"]*)\""), numbers("rpy=\"([^\"]*)\""));
  EXPECT_TRUE(T.linear().isApprox(turn.toRotationMatrix().cast<double>(), 1e-5));
  EXPECT_TRUE(T.translation().isApprox((turn * Eigen::Vector3f(0, 0, 2)).cast<double>(), 1e-5));
}

TEST_F(Urdf, DrawsTheBoxAboutAnyOtherMesh) {
  world_.robot.model = makeShape("cone", {{"diameter", 2}, {"height", 3}});
  const auto size = numbers("box size=\"([^\"]*)\"");
  ASSERT_EQ(size.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(size[i], i < 2 ? 2 : 3, 0.02);
}

}  // namespace
}  // namespace field_fusion::core::sim
