#include "field_fusion/core/base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace field_fusion::core {
namespace {

class SharedWork : public testing::TestWithParam<int> {};

TEST_P(SharedWork, EachPartIsDoneOnceByAWorkerThatThereIs) {
  Workers workers(GetParam());
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<std::atomic<int>> times(count);
    std::atomic<int> strangers{0};
    workers.share(count, [&](std::size_t i, int worker) {
      ++times[i];
      strangers += worker < 0 || worker >= workers.number();
    });
    for (const auto& n : times) EXPECT_EQ(n, 1);
    EXPECT_EQ(strangers, 0);
  }
}

TEST_P(SharedWork, TwoPartsNeverHaveOneWorkerAtOnce) {
  Workers workers(GetParam());
  std::vector<std::atomic<bool>> busy(static_cast<std::size_t>(workers.number()));
  std::atomic<int> clashes{0};
  workers.share(2000, [&](std::size_t, int worker) {
    clashes += busy[static_cast<std::size_t>(worker)].exchange(true);
    std::this_thread::yield();
    busy[static_cast<std::size_t>(worker)] = false;
  });
  EXPECT_EQ(clashes, 0);
}

TEST_P(SharedWork, WhatAPartThrowsReachesTheCaller) {
  Workers workers(GetParam());
  const auto fail = [](std::size_t i, int) {
    if (i == 17) throw std::runtime_error("part 17");
  };
  EXPECT_THROW(workers.share(100, fail), std::runtime_error);
  std::atomic<int> done{0};
  workers.share(100, [&](std::size_t, int) { ++done; });
  EXPECT_EQ(done, 100);
}

INSTANTIATE_TEST_SUITE_P(Workers, SharedWork, testing::Values(0, 1, 2, 5));

TEST(Workers, AreAsManyAsAsked) {
  EXPECT_EQ(Workers(3).number(), 3);
  EXPECT_EQ(Workers(1).number(), 1);
  EXPECT_GE(Workers(0).number(), 1);
}

}  // namespace
}  // namespace field_fusion::core
