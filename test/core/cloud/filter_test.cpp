#include "field_fusion/core/cloud/filter.h"

#include <gtest/gtest.h>

#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using test::at;

/// A point at an azimuth [deg] and range [m] in the horizontal plane.
Point bearing(double azimuth, double range = 10.0) {
  const Eigen::Vector3f p = cartesian({range, radians(azimuth), 0.0}).cast<float>();
  return at(p.x(), p.y(), p.z());
}

FilterCounts run(const FilterParams& params, const Cloud& cloud, Cloud& kept,
                 const Transform& T_box_sensor = Transform::Identity()) {
  return Filter(params).run(cloud, kept, T_box_sensor);
}

bool keeps(const FilterParams& params, const Point& p,
           const Transform& T_box_sensor = Transform::Identity()) {
  Cloud kept;
  return run(params, {p}, kept, T_box_sensor).kept == 1;
}

FilterParams sector(double from, double to) {
  FilterParams params;
  params.azimuth_min = from, params.azimuth_max = to;
  return params;
}

TEST(Filter, DefaultsDropOnlyWhatIsNotFinite) {
  Cloud kept;
  const auto counts =
      run({}, {at(1, 2, 3), at(kNaN, 0), at(-4, 5), at(0, INFINITY), at(0, 0, -INFINITY), at(0, 0)}, kept);
  EXPECT_EQ(counts.in, 6u);
  EXPECT_EQ(counts.non_finite, 3u);
  EXPECT_EQ(counts.kept, 3u);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[1].x, -4.f);
}

TEST(Filter, EmptyCloudStaysEmpty) {
  Cloud kept(3);
  EXPECT_EQ(run({}, {}, kept).kept, 0u);
  EXPECT_TRUE(kept.empty());
}

TEST(Filter, SectorKeepsItsInsideAndItsBorders) {
  for (const auto& [from, to] :
       {std::pair{-60.0, 60.0}, {30.0, 31.0}, {-170.0, 150.0}, {0.0, 180.0}, {-90.0, 90.0}}) {
    const FilterParams params = sector(from, to);
    for (const double inside : {from, from + 0.01, (from + to) / 2.0, to - 0.01, to})
      EXPECT_TRUE(keeps(params, bearing(inside))) << from << " " << to << " " << inside;
    for (const double outside : {from - 0.01, to + 0.01})
      EXPECT_FALSE(keeps(params, bearing(outside))) << from << " " << to << " " << outside;
    EXPECT_EQ(keeps(params, bearing((from + to) / 2.0 + 180.0)), to - from == 360.0);
  }
}

TEST(Filter, SectorMayRunAcrossTheBack) {
  for (const FilterParams& params : {sector(150.0, -150.0), sector(150.0, 210.0), sector(-210.0, -150.0)}) {
    EXPECT_TRUE(keeps(params, bearing(180.0)));
    EXPECT_TRUE(keeps(params, bearing(151.0)));
    EXPECT_TRUE(keeps(params, bearing(-151.0)));
    EXPECT_FALSE(keeps(params, bearing(149.0)));
    EXPECT_FALSE(keeps(params, bearing(-149.0)));
    EXPECT_FALSE(keeps(params, bearing(0.0)));
  }
}

TEST(Filter, SectorOfAFullTurnKeepsAll) {
  for (const FilterParams& params : {sector(-180.0, 180.0), sector(0.0, 360.0), sector(90.0, -270.0)})
    for (int azimuth = -180; azimuth <= 180; ++azimuth)
      EXPECT_TRUE(keeps(params, bearing(azimuth))) << azimuth;
}

TEST(Filter, SectorAgreesWithTheArctangent) {
  const FilterParams params = sector(100.0, -20.0);  // 240 deg wide
  for (const Point& p : test::fillBox(2000, {-9.f, -9.f, -9.f}, {9.f, 9.f, 9.f})) {
    const double azimuth = degrees(std::atan2(double{p.y}, double{p.x}));
    EXPECT_EQ(keeps(params, p), azimuth >= 100.0 || azimuth <= -20.0) << azimuth;
  }
}

TEST(Filter, RangeKeepsItsLimits) {
  FilterParams params;
  params.min_range = 3.0, params.max_range = 5.0;
  EXPECT_TRUE(keeps(params, at(0, 0, 3)));
  EXPECT_TRUE(keeps(params, at(3, 0, 4)));
  EXPECT_FALSE(keeps(params, at(0, std::nextafter(3.f, 0.f), 0)));
  EXPECT_FALSE(keeps(params, at(std::nextafter(5.f, 9.f), 0, 0)));
  EXPECT_FALSE(keeps(params, at(3e38f, 0, 0)));
}

TEST(Filter, BoxKeepsItsFacesAndBodyDropsThem) {
  FilterParams params;
  params.box = {-2, -2, -1, 2, 2, 1};
  params.body = {-1, -0.5, -1, 1, 0.5, 1, 1.5, 1.5, 0, 2, 2, 1};
  EXPECT_TRUE(keeps(params, at(2, -2, 1)));
  EXPECT_FALSE(keeps(params, at(2, -2, 1.001f)));
  EXPECT_FALSE(keeps(params, at(1, 0.5f, 1)));
  EXPECT_TRUE(keeps(params, at(1.001f, 0.5f, 1)));
  EXPECT_FALSE(keeps(params, at(1.7f, 1.7f, 0.5f)));
}

TEST(Filter, BoxAndBodyLieInTheFrameOfTheTransform) {
  Transform T_box_sensor = Transform::Identity();  // the sensor looks left, two metres above the box frame
  T_box_sensor.translate(Eigen::Vector3d(0, 0, 2))
      .rotate(Eigen::AngleAxisd(radians(90.0), Eigen::Vector3d::UnitZ()));
  FilterParams params;
  params.box = {-1, 0, 0, 1, 10, 3};
  EXPECT_TRUE(keeps(params, at(9, 0, -1), T_box_sensor));
  EXPECT_FALSE(keeps(params, at(9, 0, -1)));
  EXPECT_FALSE(keeps(params, at(9, 0, 1.5f), T_box_sensor));
}

TEST(Filter, CountsEachPointByTheFirstTestItFails) {
  FilterParams params = sector(-90.0, 90.0);
  params.min_range = 1.0, params.max_range = 20.0;
  params.box = {0, -5, -5, 15, 5, 5};
  params.body = {0, -1, -1, 2, 1, 1};
  params.voxel_size = 1.0;
  Cloud kept;
  const auto counts = run(params,
                          {at(kNaN, 0), at(-100, 0), at(0.5f, 0), at(30, 0), at(18, 0), at(1.5f, 0),
                           at(4.2f, 0.2f), at(4.4f, 0.4f), at(4.6f, 0.6f), at(9.5f, 0.5f)},
                          kept);
  EXPECT_EQ(counts.non_finite, 1u);
  EXPECT_EQ(counts.angle, 1u);
  EXPECT_EQ(counts.range, 2u);
  EXPECT_EQ(counts.box, 1u);
  EXPECT_EQ(counts.body, 1u);
  EXPECT_EQ(counts.merged, 2u);
  EXPECT_EQ(counts.kept, 2u);
  EXPECT_EQ(kept[0].x, 4.4f);
}

TEST(Filter, RefusesATransformThatIsNotFinite) {
  Transform broken = Transform::Identity();
  broken.translation().x() = kNaN;
  Cloud kept;
  EXPECT_THROW(Filter().run({at(1, 0)}, kept, broken), std::invalid_argument);
}

TEST(Filter, RefusesBrokenParametersByName) {
  FilterParams params;
  params.box = {0, 0, 0, 1, 1};
  params.body = {0, 0, 0, -1, 1, 1};
  params.min_range = 5.0, params.max_range = 4.0;
  params.azimuth_min = params.azimuth_max = 10.0;
  params.voxel_size = 0.001;
  try {
    Filter filter(params);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& fault) {
    for (const char* name :
         {"box must", "body must", "min_range must", "azimuth_max must", "voxel_size must"})
      EXPECT_NE(std::string(fault.what()).find(name), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace field_fusion::core
