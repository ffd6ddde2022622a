#include "field_fusion/core/scan/merge.h"

#include <gtest/gtest.h>

#include <random>

namespace field_fusion::core {
namespace {

constexpr double kPlane = 0.1;  // [m] over the ground

/// Beams of 1 degree all the way round from -180 on, all with one reading.
Scan scanOf(float reading, double range_max = 25.0) {
  Scan out;
  out.angle_min = radians(-180.0);
  out.angle_increment = radians(1.0);
  out.range_min = 0.2, out.range_max = range_max;
  out.ranges.assign(360, reading);
  return out;
}

MergeParams params1() {
  MergeParams out;
  out.azimuth_step = 1.0;
  return out;
}

/// At a height over the ground.
Transform at(double height, double pitch = 0.0) {
  Transform out = Transform::Identity();
  out.translation().z() = height - kPlane;
  out.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  return out;
}

Scan merged(std::initializer_list<std::pair<Scan, Transform>> scans, const MergeParams& params = params1()) {
  ScanMerger merger(params);
  merger.begin(kPlane);
  for (const auto& [scan, T] : scans) merger.add(scan, T);
  return merger.result();
}

TEST(ScanMerger, NearestWinsWhateverTheOrder) {
  Scan far = scanOf(5.f), near = scanOf(kNaN);
  near.ranges[180] = 2.f;
  near.ranges[90] = 7.f;
  for (const Scan& out :
       {merged({{far, at(0.5)}, {near, at(0.3)}}), merged({{near, at(0.3)}, {far, at(0.5)}})}) {
    ASSERT_EQ(out.ranges.size(), 360u);
    for (std::size_t i = 0; i < 360; ++i) EXPECT_FLOAT_EQ(out.ranges[i], i == 180 ? 2.f : 5.f) << i;
  }
}

TEST(ScanMerger, OneScanOfTheSameBinsStaysAsItIs) {
  Scan scan = scanOf(kFree);
  for (std::size_t i = 0; i < 360; i += 3) scan.ranges[i] = 1.f + 0.01f * static_cast<float>(i);
  const Scan out = merged({{scan, at(0.6)}});
  for (std::size_t i = 0; i < 360; ++i) EXPECT_FLOAT_EQ(out.ranges[i], scan.ranges[i]) << i;
}

TEST(ScanMerger, ProjectsDownAndNotAlongTheBeam) {
  // 10 degrees up, 3 m along the beam: 3 cos 10 m away, 0.52 m higher
  const Scan out = merged({{scanOf(3.f), at(0.6, -radians(10.0))}});
  EXPECT_NEAR(out.ranges[180], 3.0 * std::cos(radians(10.0)), 1e-5);
}

TEST(ScanMerger, FloorThatATiltedScannerMeetsIsNoObstacle) {
  // 5 degrees down from 0.6 m: the floor lies 6.9 m ahead
  const double floor = 0.6 / std::sin(radians(5.0));
  ScanMerger merger(params1());
  merger.begin(kPlane);
  merger.add(scanOf(static_cast<float>(floor)), at(0.6, radians(5.0)));
  EXPECT_TRUE(std::isnan(merger.result().ranges[180]));
  // the height of a beam's end is 0.6 m times 1 - cos(azimuth): below 0.05 m within 23.6 degrees
  EXPECT_EQ(merger.counts().floor, 47u);
  EXPECT_EQ(merger.counts().merged, 360u - 47u);
  EXPECT_GT(merger.result().ranges[0], 6.0f) << "behind it looks up, to 1.2 m";
}

TEST(ScanMerger, FreeOnlyWhereAScannerLookedThatSeesAsFar) {
  Scan far = scanOf(kNaN), shallow = scanOf(kFree, 8.0);
  for (std::size_t i = 0; i < 90; ++i) far.ranges[i] = kFree;
  const Scan out = merged({{far, at(0.6)}, {shallow, at(0.4)}});
  for (std::size_t i = 0; i < 360; ++i) EXPECT_EQ(out.ranges[i] == kFree, i < 90) << i;
  EXPECT_TRUE(std::isnan(out.ranges[200]));
}

TEST(ScanMerger, TooNearYieldsToARangeAndNotToFree) {
  Scan near = scanOf(kNear), other = scanOf(kFree);
  other.ranges[10] = 4.f;
  for (const Scan& out :
       {merged({{near, at(0.6)}, {other, at(0.6)}}), merged({{other, at(0.6)}, {near, at(0.6)}})}) {
    EXPECT_FLOAT_EQ(out.ranges[10], 4.f);
    EXPECT_EQ(out.ranges[11], kNear);
  }
}

TEST(ScanMerger, EachReturnIsAlgorithmOne) {
  // the paper's loop, as printed, in double precision with atan2
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double sector : {360.0, 240.0}) {
    MergeParams params;
    params.azimuth_min = -0.5 * sector, params.azimuth_max = 0.5 * sector;
    params.azimuth_step = 0.5;
    params.max_height = 100.0, params.min_height = -10.0;
    Scan scan = scanOf(kNaN);
    for (float& range : scan.ranges) range = static_cast<float>(8.0 + 7.0 * uniform(random));
    Transform T = at(0.6);
    T.translate(Eigen::Vector3d(0.3, -0.2, 0.0))
        .rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
    const Scan out = merged({{scan, T}}, params);
    std::vector<double> want(out.ranges.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const Eigen::Vector3d p =
          T * (scan.ranges[i] * Eigen::Vector3d(std::cos(scan.angle(i)), std::sin(scan.angle(i)), 0.0));
      const double place = (std::atan2(p.y(), p.x()) - out.angle_min) / out.angle_increment + 0.5;
      const auto bin = static_cast<long>(std::floor(place));
      if (bin < 0 || bin >= static_cast<long>(want.size()) + (sector == 360.0)) continue;
      double& nearest = want[static_cast<std::size_t>(bin) % want.size()];
      nearest = std::min(nearest, p.head<2>().norm());
    }
    for (std::size_t i = 0; i < want.size(); ++i) {
      if (std::isinf(want[i]))
        EXPECT_TRUE(std::isnan(out.ranges[i]));
      else
        EXPECT_NEAR(out.ranges[i], want[i], 1e-5) << i;
    }
  }
}

TEST(ScanMerger, NothingEmptyAndInvalid) {
  for (const Scan& out : {merged({}), merged({{scanOf(kNaN), at(0.6)}}), merged({{Scan{}, at(0.6)}})})
    for (const float range : out.ranges) EXPECT_TRUE(std::isnan(range));
  Scan out_of_range = scanOf(30.f, 40.0);  // sees farther than the result goes
  out_of_range.ranges[0] = 0.25f;
  MergeParams params = params1();
  params.range_min = 0.3;
  ScanMerger merger(params);
  merger.begin(kPlane);
  merger.add(out_of_range, at(0.6));
  EXPECT_EQ(merger.counts().out_of_range, 360u);
}

TEST(ScanMerger, ImpossibleParametersAreRefused) {
  MergeParams params;
  params.azimuth_min = 10.0, params.azimuth_max = 5.0;
  EXPECT_THROW(ScanMerger{params}, std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
