#include "field_fusion/core/match/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace field_fusion::core {
namespace {

constexpr double kAlone = 10.0;

double totalCost(const std::vector<int>& columns, const std::vector<Candidate>& candidates) {
  double sum = 0.0;
  for (std::size_t row = 0; row < columns.size(); ++row) {
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return c.row == static_cast<int>(row) && c.column == columns[row];
    });
    sum += columns[row] < 0 ? kAlone : found == candidates.end() ? 1e9 : found->cost;
  }
  return sum;
}

/// Every way there is.
double leastCost(int row, int rows, std::set<int>& taken, const std::vector<Candidate>& candidates) {
  if (row == rows) return 0.0;
  double least = kAlone + leastCost(row + 1, rows, taken, candidates);
  for (const Candidate& c : candidates) {
    if (c.row != row || taken.count(c.column)) continue;
    taken.insert(c.column);
    least = std::min(least, c.cost + leastCost(row + 1, rows, taken, candidates));
    taken.erase(c.column);
  }
  return least;
}

std::vector<Candidate> scatter(int rows, int columns, double share, std::mt19937& random) {
  std::uniform_real_distribution<double> cost(-2.0, 12.0), any(0.0, 1.0);
  std::vector<Candidate> out;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      if (any(random) < share) out.push_back({r, c, cost(random)});
  return out;
}

TEST(Assignment, NothingGivesNothing) {
  Assignment assignment;
  EXPECT_TRUE(assignment.run(0, 0, {}, kAlone).empty());
  EXPECT_EQ(assignment.run(2, 0, {}, kAlone), (std::vector<int>{-1, -1}));
}

TEST(Assignment, GivesUpTheBestPairForABetterSum) {
  Assignment assignment;
  const std::vector<Candidate> candidates{{0, 0, 1.0}, {0, 1, 2.0}, {1, 0, 2.0}, {1, 1, 9.0}};
  EXPECT_EQ(assignment.run(2, 2, candidates, kAlone), (std::vector<int>{1, 0}));
}

TEST(Assignment, PairAsDearAsBeingAloneIsMadeAndDearerIsNot) {
  Assignment assignment;
  EXPECT_EQ(assignment.run(1, 1, {{0, 0, kAlone}}, kAlone), std::vector<int>{0});
  EXPECT_EQ(assignment.run(1, 1, {{0, 0, kAlone + 1e-9}}, kAlone), std::vector<int>{-1});
}

TEST(Assignment, CostsNoMoreThanAnyOtherWay) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> size(0, 6);
  Assignment assignment;
  for (int trial = 0; trial < 2000; ++trial) {
    const int rows = size(random), columns = size(random);
    const auto candidates = scatter(rows, columns, trial % 2 ? 1.0 : 0.4, random);
    const auto& columns_of = assignment.run(rows, columns, candidates, kAlone);
    std::set<int> used;
    for (const int c : columns_of) EXPECT_TRUE(c < 0 || used.insert(c).second) << "one column, one row";
    std::set<int> none;
    EXPECT_NEAR(totalCost(columns_of, candidates), leastCost(0, rows, none, candidates), 1e-9);
  }
}

TEST(Assignment, EqualCostsEverywhereStillMakeAllPairs) {
  std::vector<Candidate> candidates;
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c) candidates.push_back({r, c, 3.0});
  auto columns = Assignment().run(40, 40, candidates, kAlone);
  std::sort(columns.begin(), columns.end());
  for (int i = 0; i < 40; ++i) EXPECT_EQ(columns[i], i);
}

TEST(Assignment, FindsThePlantedPairsOf500) {
  std::mt19937 random(2);
  std::vector<int> planted(500);
  for (int i = 0; i < 500; ++i) planted[i] = i;
  std::shuffle(planted.begin(), planted.end(), random);
  std::uniform_real_distribution<double> other(1.0, 5.0);
  std::vector<Candidate> candidates;
  for (int r = 0; r < 500; ++r)
    for (int c = 0; c < 500; ++c) candidates.push_back({r, c, planted[r] == c ? 0.5 : other(random)});
  EXPECT_EQ(Assignment().run(500, 500, candidates, kAlone), planted);
}

}  // namespace
}  // namespace field_fusion::core
