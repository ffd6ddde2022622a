#include "field_fusion/core/base/workers.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace field_fusion::core {

/// Not TBB's, which Embree limits to one thread in all of the process: see newDevice in sim.
struct Workers::Crew {
  struct Work {
    std::size_t count;
    const void* job;
    Call call;
  };

  explicit Crew(int others) {
    for (int worker = 1; worker <= others; ++worker) threads.emplace_back([this, worker] { help(worker); });
  }

  ~Crew() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ended = true;
    }
    changed.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  /// Who wakes when all is done already goes back to sleep: nobody waits for them.
  void run(const Work& w) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      work = w, open = true, fault = nullptr, next = 0;
    }
    changed.notify_all();
    take(w, 0);
    std::unique_lock<std::mutex> lock(mutex);
    open = false;
    changed.wait(lock, [this] { return helping == 0; });
    if (fault) std::rethrow_exception(std::exchange(fault, nullptr));
  }

  void help(int worker) {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return ended || (open && next < work.count); });
      if (ended) return;
      ++helping;
      const Work w = work;
      lock.unlock();
      take(w, worker);
      lock.lock();
      if (--helping == 0) changed.notify_all();
    }
  }

  /// One by one: the sky costs less than boats.
  void take(const Work& w, int worker) {
    try {
      for (std::size_t i = next++; i < w.count; i = next++) w.call(w.job, i, worker);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!fault) fault = std::current_exception();
      next = w.count;
    }
  }

  std::mutex mutex;
  std::condition_variable changed;
  Work work{};
  std::atomic<std::size_t> next{0};
  bool open = false, ended = false;
  int helping = 0;
  std::exception_ptr fault;
  std::vector<std::thread> threads;  // last: they use all of the above
};

Workers::Workers(int threads)
    : number_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      crew_(std::make_unique<Crew>(number_ - 1)) {}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;

void Workers::share(std::size_t count, const void* job, Call call) { crew_->run({count, job, call}); }

}  // namespace field_fusion::core
