#include "field_fusion/core/cloud/deskew.h"

#include <gtest/gtest.h>

#include "support/moving_scanner.h"

namespace field_fusion::core {
namespace {

constexpr double kStamp = 2.0;

/// 16 rows of 360 columns; a column is measured at once, the rows come one after another or columns do.
Cloud cloudOf(const test::Motion& motion, double first, bool by_rows) {
  Cloud out;
  for (int k = 0; k < 16 * 360; ++k) {
    const int row = by_rows ? k / 360 : k % 16, column = by_rows ? k % 360 : k / 16;
    const Eigen::Vector3d to = cartesian({1.0, radians(column), radians(2.0 * row - 15.0)});
    const double time = first + 0.1 * column / 360.0;
    const Transform pose = motion(kStamp + time);
    Point p;
    const Eigen::Vector3d at = test::Room{}.range(pose.translation(), pose.linear() * to) * to;
    p.x = static_cast<float>(at.x()), p.y = static_cast<float>(at.y()), p.z = static_cast<float>(at.z());
    p.time = static_cast<float>(time), p.ring = static_cast<std::uint16_t>(row), p.intensity = 7.f;
    out.push_back(p);
  }
  return out;
}

Cloud deskewed(const Cloud& cloud, const test::Motion& motion, Instant instant) {
  MotionTrack track;
  Cloud out;
  const Sweep sweep = sweepOf(cloud).sweep;
  track.follow(test::historyOf(motion, kStamp - 0.2, kStamp + 0.3), kStamp, sweep, sweep.at(instant),
               Transform::Identity());
  deskew(cloud, track, out);
  return out;
}

TEST(CloudDeskew, TrottingLeavesTheWallsStraightHoweverThePointsAreOrdered) {
  for (const bool by_rows : {false, true})
    for (const double first : {0.0, -0.1, -0.05})
      for (const Instant instant : {Instant::kStart, Instant::kMiddle, Instant::kEnd}) {
        const Cloud cloud = cloudOf(test::trot, first, by_rows);
        const Cloud out = deskewed(cloud, test::trot, instant);
        const Transform pose = test::trot(kStamp + sweepOf(cloud).sweep.at(instant));
        double worst = 0.0;
        for (const Point& p : out)
          worst = std::max(worst, test::Room{}.off(pose * p.position().cast<double>()));
        EXPECT_LT(worst, 3e-4) << by_rows << " " << first;
      }
}

TEST(CloudDeskew, KeepsOrderRingAndIntensityAndTheTimeIsTheInstant) {
  const Cloud cloud = cloudOf(test::trot, 0.0, true);
  const Cloud out = deskewed(cloud, test::trot, Instant::kStart);
  ASSERT_EQ(out.size(), cloud.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_EQ(out[i].ring, cloud[i].ring);
    EXPECT_EQ(out[i].intensity, 7.f);
    EXPECT_EQ(out[i].time, 0.f);
  }
  EXPECT_EQ(out[0].position(), cloud[0].position()) << "measured at the instant itself";
}

TEST(CloudDeskew, PointsWithoutTimeStayAndPlacesThatAreNotFiniteDoNoHarm) {
  Cloud cloud = cloudOf(test::trot, 0.0, false);
  cloud[100].time = kNaN;
  cloud[200].x = kNaN;
  EXPECT_EQ(sweepOf(cloud).untimed, 1u);
  const Cloud out = deskewed(cloud, test::trot, Instant::kEnd);
  EXPECT_EQ(out[100].position(), cloud[100].position());
  EXPECT_TRUE(std::isnan(out[100].time));
  EXPECT_FALSE(out[200].position().allFinite());
  EXPECT_TRUE(out[201].position().allFinite());
}

TEST(CloudSweep, GoesFromTheStampOrTheFirstPointToTheStampOrTheLast) {
  const auto sweep = [](std::initializer_list<float> times) {
    Cloud cloud;
    for (const float time : times) cloud.emplace_back(), cloud.back().time = time;
    return sweepOf(cloud);
  };
  EXPECT_EQ(sweep({0.001f, 0.1f}).sweep.begin, 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(sweep({0.001f, 0.1f}).sweep.end), 0.1f);
  EXPECT_FLOAT_EQ(static_cast<float>(sweep({-0.1f, -0.01f}).sweep.begin), -0.1f);
  EXPECT_EQ(sweep({-0.1f, -0.01f}).sweep.end, 0.0);
  EXPECT_TRUE(sweep({0.f, 0.f}).known) << "all at one instant";
  EXPECT_TRUE(sweep({kNaN, 0.1f}).known);
  EXPECT_FALSE(sweep({kNaN, kNaN}).known);
  EXPECT_TRUE(sweep({}).known) << "nothing to know";
}

TEST(CloudDeskew, EmptyCloudStaysEmpty) {
  Cloud out(3);
  MotionTrack track;
  deskew({}, track, out);
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace field_fusion::core
