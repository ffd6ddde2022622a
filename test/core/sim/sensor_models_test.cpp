#include "field_fusion/core/sim/sensor_models.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "support/sim_worlds.h"
#include "support/temp_folder.h"

namespace field_fusion::core::sim {
namespace {

const std::string kFolder = PROJECT_DIR "/config/sensors";

TEST(SensorModels, AreOfTheirKindAndRate) {
  const std::map<std::string, std::pair<std::string, double>> models = {
      {"lms141", {"scanner2d", 50.0}},       {"rplidar_a3", {"scanner2d", 10.0}},
      {"vlp16", {"lidar3d", 10.0}},          {"helios16", {"lidar3d", 10.0}},
      {"hdl64", {"lidar3d", 10.0}},          {"d435", {"depth_camera", 30.0}},
      {"xfk_4k415", {"camera", 30.0}},       {"wide_105", {"camera", 30.0}},
      {"camera_640", {"camera", 30.0}},      {"camera_1080p", {"camera", 30.0}},
      {"bmi055", {"imu", 200.0}},            {"icm20948", {"imu", 200.0}},
      {"gnss", {"gnss", 5.0}},               {"wheel_odometry", {"wheel_odometry", 50.0}},
      {"leg_odometry", {"leg_odometry", 500.0}}};
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    files.insert(entry.path().stem().string());
  EXPECT_EQ(files.size(), models.size());
  for (const auto& [name, expected] : models) {
    EXPECT_TRUE(files.count(name)) << name;
    EXPECT_EQ(sensorKind(kFolder, name).name, expected.first) << name;
    EXPECT_EQ(std::visit([](const auto& p) { return p.rate; }, sensorParams(kFolder, name)), expected.second);
  }
}

/// The table and the variant name the same kinds in the same order.
TEST(SensorModels, TheTableHasAnEntryForEachKindOfParameters) {
  ASSERT_EQ(sensorKinds().size(), std::variant_size_v<SensorParams>);
  std::set<std::string> seen;
  for (std::size_t i = 0; i < sensorKinds().size(); ++i) {
    const SensorKind& kind = sensorKinds()[i];
    EXPECT_TRUE(seen.insert(kind.name).second) << kind.name;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder))
      if (std::string(kind.name) == sensorKind(kFolder, entry.path().stem()).name) {
        EXPECT_EQ(kind.read(entry.path(), {}).index(), i) << entry.path();
      }
  }
}

template <class P>
P paramsOf(const std::string& model, const Overrides& overrides = {}) {
  return std::get<P>(sensorParams(kFolder, model, overrides));
}

TEST(SensorModels, HaveTheShapeOfTheirDataSheets) {
  EXPECT_EQ(paramsOf<Scanner2dParams>("lms141").steps() + 1, 541);
  EXPECT_EQ(paramsOf<Scanner2dParams>("rplidar_a3").steps(), 1600);
  EXPECT_EQ(paramsOf<Lidar3dParams>("vlp16").columns(), 1808);
  EXPECT_EQ(paramsOf<Lidar3dParams>("helios16").columns(), 1799);
  const auto hdl64 = paramsOf<Lidar3dParams>("hdl64");
  EXPECT_EQ(hdl64.columns(), 2083);
  EXPECT_EQ(hdl64.elevations.size(), 64u);
  EXPECT_NEAR(hdl64.elevations.back(), 2.0, 1e-3);
  const auto spot = spotSize(paramsOf<Scanner2dParams>("lms141").beam, 20.f);
  EXPECT_NEAR(spot.x(), 0.308, 1e-6);
}

TEST(SensorModels, OfScannersStayWithinTheAccuracyOfTheirDataSheets) {
  const auto a3 = paramsOf<Scanner2dParams>("rplidar_a3").beam;
  for (const auto& [range, share] : std::map<double, double>{{3.0, 0.01}, {5.0, 0.02}, {25.0, 0.03}}) {
    const double sigma = std::hypot(a3.range_noise, a3.range_noise_square * range * range);
    EXPECT_LT(2.0 * sigma, share * range);
  }
  const auto lms = paramsOf<Scanner2dParams>("lms141").beam;
  EXPECT_LE(std::hypot(lms.range_noise, lms.range_noise_weak), 0.02);
}

TEST(SensorModels, AreChangedByOverrides) {
  const auto params = paramsOf<Lidar3dParams>(
      "vlp16", {{"rate", "20.0"}, {"elevations", "[-1.0, 0.0]"}, {"fire_times", "[1]"}, {"echo", "last"}});
  EXPECT_EQ(params.rate, 20.0);
  EXPECT_EQ(params.elevations, (std::vector<double>{-1.0, 0.0}));
  EXPECT_EQ(params.beam.echo, Echo::kLast);
}

/// What is said of an override.
std::string faultOf(const Overrides& overrides) {
  try {
    sensorParams(kFolder, "lms141", overrides);
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "";
}

TEST(SensorModels, RefuseOverridesThatAreWrong) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(faultOf({{"ratte", "50"}}), "ratte: unknown parameter");
  says(faultOf({{"rate", "0"}}), "rate = 0.0 is outside [0.1, 1000.0] Hz");
  says(faultOf({{"rate", ".nan"}}), "rate = .nan is outside");
  says(faultOf({{"rate", "fast"}}), "rate: must be a double");
  says(faultOf({{"echo", "loudest"}}), "echo = 'loudest' is none of strongest | first | last");
  says(faultOf({{"min_range", "60"}}), "min_range must be below max_range");
}

class SensorFile : public ::testing::Test {
 protected:
  /// What is said of a file that holds `text`.
  std::string faultIn(const std::string& text) {
    folder_.write("mine.yaml", text);
    try {
      sensorParams(folder_.path().string(), "mine");
    } catch (const std::runtime_error& fault) {
      EXPECT_EQ(std::string(fault.what()).find((folder_.path() / "mine.yaml").string()), 0u) << fault.what();
      return fault.what();
    }
    return "";
  }
  void expectFault(const std::string& text, const std::string& part) {
    const std::string fault = faultIn(text);
    EXPECT_NE(fault.find(part), std::string::npos) << fault;
  }
  test::TempFolder folder_;
};

TEST_F(SensorFile, NamesLineAndKeyOfAFault) {
  expectFault("kind: scanner2d\nrate: 50.0\nangel_step: 0.5\n", "mine.yaml:3: angel_step: unknown parameter");
  expectFault("kind: scanner2d\n\nrate: [1.0]\n", "mine.yaml:3: rate: must be a double");
  expectFault("kind: scanner2d\nrate: 50.0\nrate: 50.0\n", "mine.yaml:3: rate is there twice");
  expectFault("kind: scanner2d\nrate: -1.0\n", "mine.yaml:2: rate = -1.0 is outside");
  expectFault("rate: 50.0\nkind: radar\n", "mine.yaml:2: kind 'radar' is none of");
}

TEST_F(SensorFile, MustBeComplete) {
  expectFault("kind: scanner2d\nrate: 50.0\n", "field_of_view is missing");
  expectFault("rate: 50.0\n", "kind is missing");
  expectFault("", "must be a table");
  expectFault("kind: {", "mine.yaml:");
}

TEST_F(SensorFile, MustBeThere) { EXPECT_THROW(sensorParams(kFolder, "lms999"), std::runtime_error); }

TEST(SeedOf, IsAnotherForAnotherSensorRunAndTime) {
  const std::set<std::uint64_t> seeds = {seedOf(1, "front"), seedOf(2, "front"), seedOf(1, "rear"),
                                         seedOf(seedOf(1, "front"), 0.0), seedOf(seedOf(1, "front"), 0.1)};
  EXPECT_EQ(seeds.size(), 5u);
}

TEST(BeamRandom, IsUniformAndNormal) {
  std::vector<float> uniform, normal;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    BeamRandom random(1, i);
    uniform.push_back(random.uniform());
    normal.push_back(random.normal()), normal.push_back(random.normal());
  }
  EXPECT_NEAR(test::spreadOf(uniform).mean, 0.5, 4.0 * 0.289 / std::sqrt(1e5));
  EXPECT_NEAR(test::spreadOf(uniform).sigma, 1.0 / std::sqrt(12.0), 0.002);
  EXPECT_NEAR(test::spreadOf(normal).mean, 0.0, 4.0 / std::sqrt(2e5));
  EXPECT_NEAR(test::spreadOf(normal).sigma, 1.0, 4.0 / std::sqrt(4e5));
}

}  // namespace
}  // namespace field_fusion::core::sim
