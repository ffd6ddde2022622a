#include "field_fusion/core/cloud/depth_scan.h"

#include <gtest/gtest.h>

#include "support/depth_room.h"

namespace field_fusion::core {
namespace {

using test::DepthRoom;

Scan scanOf(const DepthRoom& room, const DepthScanParams& params = {}, DepthScanCounts* counts = nullptr) {
  const auto pixels = room.pixels<std::uint16_t>(0.001);
  Scan out;
  const auto found = DepthScanner(params).run(room.image(pixels), room.place(), out);
  if (counts) *counts = found;
  return out;
}

float ahead(const Scan& scan, double azimuth_deg = 0.0) {
  const auto beam = std::lround((radians(azimuth_deg) - scan.angle_min) / scan.angle_increment);
  return scan.ranges.at(static_cast<std::size_t>(beam));
}

/// The wall fills the beams between +-25 degrees, where the camera surely sees it.
void expectTheWall(const Scan& scan, double distance, double slack) {
  for (double azimuth = -25.0; azimuth <= 25.0; azimuth += 0.5) {
    // a beam holds what lies within half a step of it
    const double least = distance / std::cos(radians(std::max(0.0, std::abs(azimuth) - 0.26)));
    EXPECT_NEAR(ahead(scan, azimuth), least, slack) << azimuth;
  }
}

TEST(DepthScan, TiltedCameraSeesTheWallWhereItIsAndNoFloor) {
  DepthScanCounts counts;
  const Scan scan = scanOf({}, {}, &counts);
  expectTheWall(scan, 3.0, 0.003);
  EXPECT_GT(counts.floor, 10000u);
  EXPECT_EQ(scan.ranges.size(), 720u);
  EXPECT_TRUE(std::isnan(ahead(scan, 90.0))) << "nobody looked there";
  EXPECT_TRUE(std::isnan(ahead(scan, -180.0)));
}

TEST(DepthScan, PitchAndRollOfTheBodyDoNotMoveTheWall) {
  DepthRoom room;
  room.T_ground_base.rotate(Eigen::AngleAxisd(radians(5.0), Eigen::Vector3d(1, 1, 0).normalized()));
  expectTheWall(scanOf(room), 3.0, 0.006);
}

TEST(DepthScan, MillimetresMetresAndPointsSayTheSame) {
  const DepthRoom room;
  const auto millimetres = room.pixels<std::uint16_t>(0.001);
  std::vector<float> metres;
  Cloud cloud;
  for (std::size_t i = 0; i < millimetres.size(); ++i) {
    const float z = 0.001f * static_cast<float>(millimetres[i]);
    metres.push_back(millimetres[i] == 0 ? kNaN : z);
    Point p;
    p.x = static_cast<float>((static_cast<double>(i % 640) - 320.0) / room.focal) * z;
    p.y = static_cast<float>((static_cast<double>(i / 640) - 240.0) / room.focal) * z;
    p.z = millimetres[i] == 0 ? kNaN : z;
    cloud.push_back(p);
  }
  Scan a, b, c;
  DepthScanner scanner;
  scanner.run(room.image(millimetres), room.place(), a);
  scanner.run(room.image(metres), room.place(), b);
  scanner.run(cloud, room.place(), c);
  int differ = 0;  // points on the border of two beams
  for (std::size_t i = 0; i < a.ranges.size(); ++i) {
    const bool unknown = std::isnan(a.ranges[i]);
    EXPECT_EQ(std::isnan(b.ranges[i]), unknown);
    if (unknown) continue;
    EXPECT_FLOAT_EQ(b.ranges[i], a.ranges[i]);
    differ += !(std::abs(c.ranges[i] - a.ranges[i]) < 1e-3f || c.ranges[i] == a.ranges[i]);
  }
  EXPECT_LE(differ, 2);
}

TEST(DepthScan, LowAndHighBodiesAreToldFromFloorAndBand) {
  DepthRoom room;
  room.wall = 100.0;
  room.boxes = {{Eigen::Vector3d(2.0, -0.3, 0.0),
                 Eigen::Vector3d(2.3, 0.3, 0.12)}};  // lower than a planar scanner sees
  EXPECT_NEAR(ahead(scanOf(room)), 2.0, 0.02);
  room.boxes = {{Eigen::Vector3d(2.0, -0.3, 0.0), Eigen::Vector3d(2.3, 0.3, 0.03)}};  // a step one walks over
  EXPECT_EQ(ahead(scanOf(room)), kFree);
  room.boxes = {
      {Eigen::Vector3d(2.0, -0.3, 0.65), Eigen::Vector3d(2.3, 0.3, 1.2)}};  // a table top passed below
  EXPECT_EQ(ahead(scanOf(room)), kFree);
}

TEST(DepthScan, OwnLegsAreNoObstacle) {
  DepthRoom room;
  room.boxes = {{Eigen::Vector3d(0.55, -0.05, 0.0), Eigen::Vector3d(0.6, 0.05, 0.3)}};
  EXPECT_NEAR(ahead(scanOf(room)), 0.55, 0.01);
  DepthScanParams params;
  params.body = {0.5, -0.1, 0.0, 0.65, 0.1, 0.35};
  DepthScanCounts counts;
  // what it hides is not known: 0.3 to 0.6 m of it are the robot's, over it one sees the wall
  const float seen = ahead(scanOf(room, params, &counts));
  EXPECT_GT(counts.body, 100u);
  EXPECT_TRUE(std::isnan(seen) || seen > 2.9f);
}

TEST(DepthScan, SingleWrongPixelsAreNoise) {
  const DepthRoom room;
  auto pixels = room.pixels<std::uint16_t>(0.001);
  pixels[200 * 640 + 320] = 1000;  // in the air before the wall
  pixels[201 * 640 + 320] = 1000;
  Scan scan;
  DepthScanCounts counts = DepthScanner().run(room.image(pixels), room.place(), scan);
  EXPECT_NEAR(ahead(scan), 3.0, 0.003);
  EXPECT_GE(counts.noise, 2u);
  pixels[202 * 640 + 320] = 1000;
  DepthScanner().run(room.image(pixels), room.place(), scan);
  EXPECT_LT(ahead(scan), 1.5f) << "three count";
}

TEST(DepthScan, AllZeroIsNotLookedAtAndNotFree) {
  DepthRoom room;
  const std::vector<std::uint16_t> zero(640 * 480, 0);
  Scan scan;
  EXPECT_EQ(DepthScanner().run(room.image(zero), room.place(), scan).seen, 0u);
  for (const float range : scan.ranges) EXPECT_TRUE(std::isnan(range));
  const std::vector<float> infinite(640 * 480, kFree);
  EXPECT_EQ(DepthScanner().run(room.image(infinite), room.place(), scan).seen, 0u);
}

TEST(DepthScan, NearestOfABeamIsKept) {
  Cloud cloud;
  for (const float range : {2.0f, 2.01f, 2.02f, 1.5f, 1.51f, 1.52f, 4.f, 4.f, 4.f}) {
    Point p;
    p.x = range, p.z = 0.2f;
    cloud.push_back(p);
  }
  Scan scan;
  EXPECT_EQ(DepthScanner().run(cloud, {}, scan).kept, 9u);
  EXPECT_FLOAT_EQ(ahead(scan), 1.5f);
}

TEST(DepthScan, EmptyNotFiniteAndOutOfRange) {
  Scan scan;
  DepthScanner scanner;
  EXPECT_EQ(scanner.run(Cloud{}, {}, scan).seen, 0u);
  EXPECT_EQ(scan.ranges.size(), 720u);
  Cloud cloud(4);
  cloud[0].x = kNaN;
  cloud[1].x = kFree;
  cloud[2].x = 0.05f, cloud[2].z = 0.2f;
  cloud[3].x = 20.f, cloud[3].z = 0.4f;
  const auto counts = scanner.run(cloud, {}, scan);
  EXPECT_EQ(counts.seen, 2u);
  EXPECT_EQ(counts.out_of_range, 2u);
  EXPECT_EQ(ahead(scan), kFree) << "something farther away was seen there";
  EXPECT_EQ(scanner.run(DepthImage<float>{}, {}, scan).seen, 0u);
}

TEST(DepthScan, ImpossibleParametersAreRefused) {
  DepthScanParams params;
  params.min_height = 1.0;
  EXPECT_THROW(DepthScanner{params}, std::invalid_argument);
  params = {};
  params.body = {1.0, 2.0};
  EXPECT_THROW(DepthScanner{params}, std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
