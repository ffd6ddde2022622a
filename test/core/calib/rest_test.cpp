#include "field_fusion/core/calib/rest.h"

#include <gtest/gtest.h>

namespace field_fusion::core {
namespace {

/// Two corners at a place [px], `noise` aside.
Sighting at(double stamp, double place, double noise = 0.0) {
  return {stamp, {{place + noise, 10.0}, {place + 20.0 - noise, 10.0}}};
}

TEST(Rest, IsFoundWhereTheBoardStandsLongEnough) {
  std::vector<Sighting> all;
  for (int i = 0; i < 6; ++i) all.push_back(at(0.2 * i, 100.0, i % 2 ? 0.1 : -0.1));
  for (int i = 6; i < 10; ++i) all.push_back(at(0.2 * i, 100.0 + 30.0 * (i - 5)));  // carried on
  for (int i = 10; i < 13; ++i) all.push_back(at(0.2 * i, 300.0));                  // 0.4 s: too short
  for (int i = 13; i < 18; ++i) all.push_back(at(0.2 * i, 400.0));
  const auto rests = findRests(all, {});
  ASSERT_EQ(rests.size(), 2u);
  EXPECT_DOUBLE_EQ(rests[0].begin, 0.0);
  EXPECT_DOUBLE_EQ(rests[0].end, 1.0);
  EXPECT_EQ(rests[0].last, 5u);
  EXPECT_NEAR(rests[0].corners[0].x(), 100.0, 1e-12);  // the mean
  EXPECT_NEAR(rests[1].corners[0].x(), 400.0, 1e-12);
}

TEST(Rest, OneWhoseCornersAreInTheOppositeOrderIsTheSame) {
  std::vector<Sighting> all;
  for (int i = 0; i < 6; ++i) all.push_back(at(0.2 * i, 100.0));
  std::swap(all[3].corners[0], all[3].corners[1]);
  const auto rests = findRests(all, {});
  ASSERT_EQ(rests.size(), 1u);
  EXPECT_NEAR(rests[0].corners[0].x(), 100.0, 1e-12);
}

TEST(Rest, TheSamePlaceCountsOnce) {
  std::vector<Sighting> all;
  for (int i = 0; i < 6; ++i) all.push_back(at(0.2 * i, 100.0));
  for (int i = 0; i < 6; ++i) all.push_back(at(5.0 + 0.2 * i, 103.0));
  EXPECT_EQ(findRests(all, {}).size(), 1u);
}

TEST(Rest, ASlowDriftIsNone) {
  std::vector<Sighting> all;
  for (int i = 0; i < 50; ++i) all.push_back(at(0.1 * i, 100.0 + 0.2 * i));
  EXPECT_TRUE(findRests(all, {}).empty());
}

TEST(Rest, NoneInNothingAndInOne) {
  EXPECT_TRUE(findRests({}, {}).empty());
  EXPECT_TRUE(findRests({at(0.0, 100.0)}, {}).empty());
  EXPECT_THROW(findRests({{0.0, {}}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core
