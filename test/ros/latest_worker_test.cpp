#include "field_fusion/ros/latest_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <vector>

namespace field_fusion {
namespace {

TEST(LatestWorker, NewestWinsAndTheReplacedIsReported) {
  std::promise<void> begun, release;
  std::vector<int> done;
  {
    std::promise<void> third;
    LatestWorker<int> worker(
        [&](int&& job) {
          done.push_back(job);
          if (job == 1) {
            begun.set_value();
            release.get_future().wait();
          }
          if (job == 3) third.set_value();
        },
        10);
    EXPECT_FALSE(worker.offer(1));
    begun.get_future().wait();
    EXPECT_FALSE(worker.offer(2)) << "1 has begun, nothing is pushed out";
    EXPECT_TRUE(worker.offer(3)) << "2 had not begun";
    release.set_value();
    third.get_future().wait();
  }
  EXPECT_EQ(done, (std::vector<int>{1, 3}));
}

TEST(LatestWorker, EndsWithoutBeginningTheJobThatWaits) {
  std::promise<void> begun;
  std::vector<int> done;
  auto worker = std::make_unique<LatestWorker<int>>(
      [&](int&& job) {
        done.push_back(job);
        begun.set_value();
        // long enough for the destructor to be called while this job runs and the next one waits
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
      },
      0);
  worker->offer(1);
  begun.get_future().wait();
  worker->offer(2);
  worker.reset();
  EXPECT_EQ(done, std::vector<int>{1});
}

TEST(LatestWorker, ClearedJobIsNotDone) {
  std::promise<void> begun, release;
  std::vector<int> done;
  {
    LatestWorker<int> worker(
        [&](int&& job) {
          done.push_back(job);
          if (job == 1) {
            begun.set_value();
            release.get_future().wait();
          }
        },
        0);
    worker.offer(1);
    begun.get_future().wait();
    worker.offer(2);
    worker.clear();
    release.set_value();
  }
  EXPECT_EQ(done, std::vector<int>{1});
}

}  // namespace
}  // namespace field_fusion
