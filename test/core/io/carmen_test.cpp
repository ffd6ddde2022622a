#include "field_fusion/core/io/carmen.h"

#include <gtest/gtest.h>

#include <fstream>
#include <unistd.h>

namespace field_fusion::core {
namespace {

CarmenLog read(const std::string& text, bool sensor_stamps = true) {
  const auto path = std::filesystem::temp_directory_path() / ("carmen_" + std::to_string(getpid()) + ".log");
  std::ofstream(path) << text;
  return readCarmen(path, sensor_stamps);
}

std::string beams(int n) {
  std::string out = std::to_string(n);
  for (int i = 0; i < n; ++i) out += " 1.5";
  return out;
}

TEST(Carmen, ReadsEveryKindOfScan) {
  const auto log = read("# comment\nPARAM x y\nODOM 1 2 0.5 0 0 0 9.25 host 10.5\nFLASER " + beams(181) +
                        " 1 2 3 1.1 2.2 0.3 976052890.244111 host 7.5\n"
                        "ROBOTLASER1 0 -2.0 4.0 0.02 30.0 0.1 0 2 3.5 4.5 1 9 0.1 0 0 0.2 0 0 0 0 0.1 0.1 0 5.5 host 6.5\n"
                        "RAWLASER1 0 -1.0 2.0 0.01 80.0 0.1 0 1 2.5 0 4.5 host 4.75\n");
  ASSERT_EQ(log.scans.size(), 3u);
  ASSERT_EQ(log.odometry.size(), 1u);
  EXPECT_EQ(log.odometry[0].stamp_ns, 9'250'000'000);
  EXPECT_EQ(log.scans[0].stamp_ns, 976052890'244111000);
  EXPECT_EQ(log.scans[0].ranges.size(), 181u);
  EXPECT_NEAR(log.scans[0].angle_min, radians(-90.0), 1e-12);
  EXPECT_NEAR(log.scans[0].angle_increment, radians(1.0), 1e-12);
  EXPECT_EQ(log.scans[0].odometry.x, 1.1);
  EXPECT_EQ(log.scans[0].laser.yaw, 3.0);
  EXPECT_EQ(log.scans[1].angle_min, -2.0);
  EXPECT_EQ(log.scans[1].max_range, 30.0);
  EXPECT_EQ(log.scans[1].ranges[1], 4.5f);
  EXPECT_EQ(log.scans[1].odometry.x, 0.2);
  EXPECT_EQ(log.scans[1].stamp_ns, 5'500'000'000);
  EXPECT_EQ(log.scans[2].odometry.yaw, 0.5) << "of the ODOM line before";
}

TEST(Carmen, StepsOfScannersThatTheLogDoesNotName) {
  for (const auto& [n, step] : std::vector<std::pair<int, double>>{{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}, {401, 0.25}})
    EXPECT_NEAR(degrees(read("FLASER " + beams(n) + " 0 0 0 0 0 0 1.0 h 1.0\n").scans[0].angle_increment), step, 1e-9) << n;
}

TEST(Carmen, StampsOfSensorOrLogger) {
  EXPECT_EQ(read("ODOM 0 0 0 0 0 0 1.5 h 2.5\n").odometry[0].stamp_ns, 1'500'000'000);
  EXPECT_EQ(read("ODOM 0 0 0 0 0 0 1.5 h 2.5\n", false).odometry[0].stamp_ns, 2'500'000'000);
  std::int64_t ns = 0;
  EXPECT_TRUE(parseStamp("-0.000001", ns));
  EXPECT_EQ(ns, -1000);
  EXPECT_TRUE(parseStamp("1e-3", ns));
  EXPECT_EQ(ns, 1'000'000);
  for (const char* bad : {"", "x", "1.5s", "nan", "1e300"}) EXPECT_FALSE(parseStamp(bad, ns)) << bad;
}

TEST(Carmen, FaultsAreNamedByLine) {
  for (const char* bad : {"FLASER", "FLASER 3 1 2", "FLASER 1.5 1 2", "FLASER -1", "FLASER 1 a 0 0 0 0 0 0 1 h 1",
                          "FLASER 1 1 0 0 nan 0 0 0 1 h 1", "ODOM 1 2 3 0 0 0 x h 1", "ODOM 1 2", "FLASER 999999999"})
    try {
      read(std::string("ODOM 0 0 0 0 0 0 1 h 1\n") + bad + "\n");
      ADD_FAILURE() << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(":2: "), std::string::npos) << e.what();
    }
  EXPECT_THROW(readCarmen("/nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace field_fusion::core
