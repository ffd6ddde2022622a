#include "field_fusion/core/cloud/seen_through.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "field_fusion/core/cloud/dbscan.h"
#include "support/clouds.h"

namespace field_fusion::core {
namespace {

using Labels = std::vector<int>;

/// Points with the sets that they belong to; the sensor is at the origin.
struct Sets {
  Cloud cloud;
  Labels labels;
  int count = 0;

  void add(const Cloud& points) {
    cloud.insert(cloud.end(), points.begin(), points.end());
    labels.resize(cloud.size(), count++);
  }
  Labels join(double depth = 3.5) const {
    SeenThrough seen_through;
    return seen_through.run(cloud, labels, count, 0.5, depth);
  }
  /// The sets after joining that the points of set `a` and of set `b` are in are the same.
  bool joins(int a, int b, double depth = 3.5) const {
    const Labels after = join(depth);
    const auto of = [&](int set) {
      return after[std::find(labels.begin(), labels.end(), set) - labels.begin()];
    };
    return of(a) == of(b);
  }
};

/// An upright face square to x, with a hole in it.
Cloud face(double x, double y_low, double y_high, double z_low, double z_high,
           const Eigen::AlignedBox2d& hole) {
  Cloud out;
  for (double y = y_low; y <= y_high; y += 0.1)
    for (double z = z_low; z <= z_high; z += 0.1)
      if (!hole.contains(Eigen::Vector2d(y, z))) out.push_back(test::at(x, y, z));
  return out;
}
Cloud face(double x, double y_low, double y_high, double z_low, double z_high) {
  return face(x, y_low, y_high, z_low, z_high, Eigen::AlignedBox2d());
}

const Eigen::AlignedBox2d kWindow(Eigen::Vector2d(-0.6, 0.0), Eigen::Vector2d(0.6, 0.6));

TEST(SeenThrough, WhatAWindowShowsBelongsToTheBody) {
  Sets van;
  van.add(face(10, -0.9, 0.9, -1.5, 0.8, kWindow));
  van.add(face(11.5, -0.3, 0.3, 0.1, 0.4));
  EXPECT_TRUE(van.joins(0, 1));
  EXPECT_FALSE(van.joins(0, 1, 1.4));  // farther behind than the limit
}

TEST(SeenThrough, InsideTheBoxOfTwoFacesNoFrameIsNeeded) {
  Sets van;
  Cloud shell = face(10, 1.0, 2.8, -1.5, 0.0);
  for (double x = 10.0; x < 14.5; x += 0.1)
    for (double z = -1.5; z <= 0.0; z += 0.1) shell.push_back(test::at(x, 1.0, z));
  van.add(shell);
  van.add(face(12.0, 1.8, 2.2, 0.02, 0.1));  // above the shell's points, in front of none that is higher
  EXPECT_TRUE(van.joins(0, 1));
}

TEST(SeenThrough, APersonBeforeAWallIsABody) {
  Sets street;
  street.add(face(10, -3, 3, -1.5, 1.5));
  street.add(face(9, -0.2, 0.2, -1.5, 0.2));
  EXPECT_FALSE(street.joins(0, 1));
}

TEST(SeenThrough, APersonInTheCornerOfTwoWallsIsABody) {
  Sets corner;
  Cloud walls = face(10, -1.5, 1.5, -1.5, 0.5);
  for (double x = 7.0; x < 10.0; x += 0.1)
    for (double z = -1.5; z <= 0.5; z += 0.1) walls.push_back(test::at(x, 1.5, z));
  corner.add(walls);
  corner.add(face(8.5, -0.2, 0.2, -1.5, 0.2));  // in the box of the walls
  EXPECT_FALSE(corner.joins(0, 1));
}

TEST(SeenThrough, APersonBehindALowWallIsABody) {
  Sets yard;
  yard.add(face(10, -3, 3, -1.5, -0.5));
  yard.add(face(11, -0.2, 0.2, -0.4, 0.2));
  EXPECT_FALSE(yard.joins(0, 1));
}

TEST(SeenThrough, APersonBehindAFenceIsABody) {
  for (const double half_length : {2.0, 6.0}) {
    Sets yard;
    Cloud fence;
    for (double y = -half_length; y <= half_length; y += 0.3)
      for (double z = -1.5; z <= 0.7; z += 0.05) fence.push_back(test::at(5, y, z));
    yard.add(fence);
    yard.add(face(7, -0.2, 0.2, -1.4, 0.2));
    ASSERT_LE(4 * std::count(yard.labels.begin(), yard.labels.end(), 1),
              std::count(yard.labels.begin(), yard.labels.end(), 0));
    EXPECT_FALSE(yard.joins(0, 1)) << half_length;
  }
}

TEST(SeenThrough, ADogBehindALongFenceIsABody) {
  Sets yard;
  Cloud fence;
  for (double y = -6.0; y <= 6.0; y += 0.3)
    for (double z = -1.5; z <= 0.7; z += 0.05) fence.push_back(test::at(5, y, z));
  yard.add(fence);
  yard.add(face(7, -0.2, 0.2, -1.4, -0.8));
  EXPECT_FALSE(yard.joins(0, 1));
}

TEST(SeenThrough, AThingOfLikeSizeIsABody) {
  Sets street;
  street.add(face(10, -0.9, 0.9, -1.5, 0.8, kWindow));
  street.add(face(11.5, -0.7, 0.7, 0.0, 0.65));
  ASSERT_GT(4 * std::count(street.labels.begin(), street.labels.end(), 1),
            std::count(street.labels.begin(), street.labels.end(), 0));
  EXPECT_FALSE(street.joins(0, 1));
}

TEST(SeenThrough, BodiesAreNotJoinedByWhatBothEnclose) {
  Sets street;
  street.add(face(10, -0.9, 0.9, -1.5, 0.8, kWindow));
  street.add(face(11, -0.9, 0.9, -1.8, 1.0,
                  Eigen::AlignedBox2d(Eigen::Vector2d(-0.7, -0.1), Eigen::Vector2d(0.7, 0.8))));
  street.add(face(12, -0.3, 0.3, 0.1, 0.4));
  EXPECT_FALSE(street.joins(0, 1));
  EXPECT_TRUE(street.joins(0, 2));  // both enclose all of it: the nearer has it
}

TEST(SeenThrough, HoldsBehindTheSensorWhereAzimuthJumps) {
  Sets van;
  van.add(face(-10, -0.9, 0.9, -1.5, 0.8, kWindow));
  van.add(face(-11.5, -0.3, 0.3, 0.1, 0.4));
  EXPECT_TRUE(van.joins(0, 1));
}

TEST(SeenThrough, OrderOfThePointsDoesNotMatter) {
  Sets van;
  van.add(face(10, -0.9, 0.9, -1.5, 0.8, kWindow));
  van.add(face(11.5, -0.3, 0.3, 0.1, 0.4));
  van.add(face(9, 2, 2.4, -1.5, 0.2));
  std::vector<std::size_t> order(van.cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  Sets shuffled{{}, {}, van.count};
  for (const std::size_t i : order) {
    shuffled.cloud.push_back(van.cloud[i]);
    shuffled.labels.push_back(2 - van.labels[i]);
  }
  EXPECT_TRUE(shuffled.joins(2, 1));
  EXPECT_FALSE(shuffled.joins(2, 0));
}

TEST(SeenThrough, NoiseAndEmptyCloudsPass) {
  SeenThrough seen_through;
  EXPECT_TRUE(seen_through.run({}, {}, 0, 0.5, 3.5).empty());
  EXPECT_EQ(seen_through.run({test::at(1, 0), test::at(2, 0)}, {kNoise, 0}, 1, 0.5, 3.5),
            (Labels{kNoise, 0}));
  EXPECT_EQ(seen_through.clusterCount(), 1);
  EXPECT_EQ(seen_through.run(Cloud(9, test::at(0, 0)), Labels(9, 0), 1, 0.5, 3.5), Labels(9, 0));
}

}  // namespace
}  // namespace field_fusion::core
