// The defaults in the code are those of the files that cite where they come from.
#include <gtest/gtest.h>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/sim/gnss.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/core/sim/sensor_models.h"

namespace field_fusion::core::sim {
namespace {

template <class P>
void expectDefaults(const char* model) {
  P usual, read;
  Params declared = declarationOf(read);
  readSensorFile(std::string(PROJECT_DIR "/config/sensors/") + model + ".yaml", {}, declared);
  EXPECT_EQ(toYaml(declared), toYaml(declarationOf(usual))) << model;
}

TEST(MotionSensorFiles, AreTheDefaults) {
  expectDefaults<ImuParams>("bmi055");
  expectDefaults<WheelOdometryParams>("wheel_odometry");
  expectDefaults<LegOdometryParams>("leg_odometry");
  expectDefaults<GnssParams>("gnss");
}

TEST(MotionSensorFiles, AnotherInertialUnitCanBeRead) {
  ImuParams params;
  Params declared = declarationOf(params);
  readSensorFile(PROJECT_DIR "/config/sensors/icm20948.yaml", {{"rate", "100"}}, declared);
  EXPECT_EQ(params.rate, 100.0);
  EXPECT_EQ(params.accel_noise, 230.0);
}

}  // namespace
}  // namespace field_fusion::core::sim
