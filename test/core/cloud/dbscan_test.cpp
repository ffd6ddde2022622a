#include "field_fusion/core/cloud/dbscan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/brute_dbscan.h"
#include "support/clouds.h"
#include "support/street.h"

namespace field_fusion::core {
namespace {

using test::at;
using test::inOrderOfAppearance;
using Labels = std::vector<int>;

Labels labelled(const Cloud& cloud, float epsilon, int min_points) {
  return inOrderOfAppearance(Dbscan().run(cloud, epsilon, min_points));
}

TEST(Dbscan, LabelsNothingInAnEmptyCloud) { EXPECT_TRUE(labelled({}, 0.5f, 1).empty()); }

TEST(Dbscan, OnePointIsAClusterOnlyWhenOneIsEnough) {
  EXPECT_EQ(labelled({at(1, 2, 3)}, 0.5f, 1), Labels{0});
  EXPECT_EQ(labelled({at(1, 2, 3)}, 0.5f, 2), Labels{kNoise});
}

TEST(Dbscan, PointsAtExactlyEpsilonAreNeighbours) {
  EXPECT_EQ(labelled({at(0, 0), at(0.5f, 0)}, 0.5f, 2), (Labels{0, 0}));
  EXPECT_EQ(labelled({at(0, 0), at(std::nextafter(0.5f, 1.f), 0)}, 0.5f, 2), (Labels{kNoise, kNoise}));
  EXPECT_EQ(labelled({at(0, 0), at(0.3f, 0)}, 0.3f, 2), (Labels{0, 0}));
}

TEST(Dbscan, CountsThePointItselfAmongItsNeighbours) {
  EXPECT_EQ(labelled(test::line(3, 0.4f), 0.5f, 3), (Labels{0, 0, 0}));
  EXPECT_EQ(labelled(test::line(3, 0.4f), 0.5f, 4), (Labels{kNoise, kNoise, kNoise}));
}

TEST(Dbscan, GapWiderThanEpsilonParts) {
  const Cloud cloud = test::join({test::line(5, 0.1f), test::line(5, 0.1f, 1.f)});
  EXPECT_EQ(labelled(cloud, 0.5f, 3), (Labels{0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(labelled(cloud, 0.7f, 3), Labels(10, 0));
}

TEST(Dbscan, BorderPointGoesToItsNearestCorePoint) {
  // Points 0-3 and 4-7 form two dense heaps; the last point has one core neighbour in each, three in all.
  Cloud cloud = test::join({test::line(4, 0.1f), test::line(4, 0.1f, 1.2f)});
  cloud.push_back(at(0.74f, 0));
  EXPECT_EQ(labelled(cloud, 0.48f, 4), (Labels{0, 0, 0, 0, 1, 1, 1, 1, 0}));
  cloud.back() = at(0.76f, 0);
  EXPECT_EQ(labelled(cloud, 0.48f, 4), (Labels{0, 0, 0, 0, 1, 1, 1, 1, 1}));
}

TEST(Dbscan, BorderPointBetweenEquallyNearCorePointsGoesToTheEarlierOne) {
  const Cloud left{at(-1, 0), at(-1, 0.25f), at(-1, -0.25f)}, right{at(1, 0), at(1, 0.25f), at(1, -0.25f)};
  const Cloud middle{at(0, 0)};
  EXPECT_EQ(labelled(test::join({left, right, middle}), 1.f, 4), (Labels{0, 0, 0, 1, 1, 1, 0}));
  EXPECT_EQ(labelled(test::join({middle, right, left}), 1.f, 4), (Labels{0, 0, 0, 0, 1, 1, 1}));
}

TEST(Dbscan, IgnoresUnusablePoints) {
  Cloud cloud = test::line(3, 0.1f);
  cloud.insert(cloud.begin() + 1, {at(kNaN, 0), at(0.05f, INFINITY), at(2e7f, 0)});
  Dbscan dbscan;
  EXPECT_EQ(dbscan.run(cloud, 0.5f, 3), (Labels{0, kNoise, kNoise, kNoise, 0, 0}));
  EXPECT_EQ(dbscan.usableCount(), 3u);
  EXPECT_EQ(labelled(cloud, 0.5f, 4), Labels(6, kNoise));
}

TEST(Dbscan, EqualPointsAreOneClusterHoweverMany) {
  EXPECT_EQ(labelled(Cloud(100000, at(3, -4, 5)), 0.5f, 1000), Labels(100000, 0));
}

TEST(Dbscan, TwoHeapsJustOutOfReachStayApart) {
  Cloud cloud(50000, at(0, 0));
  cloud.resize(100000, at(0.5001f, 0));
  const Labels labels = labelled(cloud, 0.5f, 10);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), 50000);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 1), 50000);
}

TEST(Dbscan, FindsClustersAThousandKilometresApart) {
  const Cloud cloud = test::join({test::line(5, 0.125f, -1e6f), test::line(5, 0.125f, 1e6f, 1e6f, 1e6f)});
  EXPECT_EQ(labelled(cloud, 0.5f, 5), (Labels{0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
}

TEST(Dbscan, RefusesParametersWithoutMeaning) {
  EXPECT_THROW(labelled({}, 0.f, 10), std::invalid_argument);
  EXPECT_THROW(labelled({}, kNaN, 10), std::invalid_argument);
  EXPECT_THROW(labelled({}, 0.5f, 0), std::invalid_argument);
}

struct Case {
  float epsilon;
  int min_points;
  float size;  ///< [m] of the box that 800 points are drawn from
};

class DbscanOnRandomClouds : public testing::TestWithParam<Case> {};

TEST_P(DbscanOnRandomClouds, EqualsBruteForce) {
  const auto [epsilon, min_points, size] = GetParam();
  Dbscan dbscan;  // one for all, so that nothing may stay behind from the cloud before
  for (unsigned seed = 0; seed < 15; ++seed) {
    const Cloud cloud = test::fillBox(800, {-size, -size, -0.3f * size}, {size, size, 0.3f * size}, seed);
    const auto expected = test::bruteDbscan(cloud, epsilon, min_points);
    ASSERT_EQ(inOrderOfAppearance(dbscan.run(cloud, epsilon, min_points)), expected) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(SparseToDense, DbscanOnRandomClouds,
                         testing::Values(Case{0.5f, 10, 3.f}, Case{0.5f, 4, 4.f}, Case{0.3f, 1, 3.f},
                                         Case{0.5f, 2, 5.f}, Case{1.f, 30, 3.f}, Case{5.f, 100, 4.f},
                                         Case{0.01f, 2, 0.1f}));

// A lattice of spacing epsilon: every distance is a tie or lies on the limit.
TEST(Dbscan, EqualsBruteForceOnALattice) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(-6, 6);
  for (int round = 0; round < 20; ++round) {
    Cloud cloud;
    for (int i = 0; i < 500; ++i)
      cloud.push_back(at(0.25f * place(random), 0.25f * place(random), 0.25f * place(random)));
    for (const int min_points : {2, 5, 9})
      ASSERT_EQ(labelled(cloud, 0.25f, min_points), test::bruteDbscan(cloud, 0.25f, min_points));
  }
}

TEST(Dbscan, EqualsBruteForceOnAStreet) {
  test::StreetScan scan;
  scan.columns = 300;
  const Cloud cloud = test::scanStreet(scan).off_ground;
  ASSERT_GT(cloud.size(), 3000u);
  EXPECT_EQ(labelled(cloud, 0.8f, 5), test::bruteDbscan(cloud, 0.8f, 5));
}

TEST(Dbscan, DoesNotDependOnTheOrderOfThePoints) {
  const Cloud cloud = test::fillBox(2000, {-5.f, -5.f, -1.f}, {5.f, 5.f, 1.f});
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  Cloud shuffled;
  for (const std::size_t i : order) shuffled.push_back(cloud[i]);
  const Labels labels = Dbscan().run(shuffled, 0.5f, 10);
  Labels back(labels.size());
  for (std::size_t k = 0; k < order.size(); ++k) back[order[k]] = labels[k];
  EXPECT_EQ(inOrderOfAppearance(back), labelled(cloud, 0.5f, 10));
}

}  // namespace
}  // namespace field_fusion::core
