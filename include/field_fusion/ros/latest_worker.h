#pragma once
// A thread for slow jobs of which only the newest matters, such as a detector behind a fast camera.
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace field_fusion {

template <class Job>
class LatestWorker {
 public:
  /// `work` runs in the worker's thread and must not throw. `niceness` 0..19 keeps it behind the LiDAR chain.
  LatestWorker(std::function<void(Job&&)> work, int niceness)
      : work_(std::move(work)), thread_([this, niceness] { run(niceness); }) {}
  ~LatestWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  LatestWorker(const LatestWorker&) = delete;
  LatestWorker& operator=(const LatestWorker&) = delete;

  /// Takes a job; true when it pushed out an older one that had not begun.
  bool offer(Job job) {
    bool replaced = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      replaced = next_.has_value();
      next_ = std::move(job);
    }
    wake_.notify_one();
    return replaced;
  }

  /// Forgets a job that has not begun (time jump).
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_.reset();
  }

 private:
  void run(int niceness) {
    // on Linux a thread's niceness is its own
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), niceness);
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || next_; });
      if (stopping_) return;
      Job job = std::move(*next_);
      next_.reset();
      lock.unlock();
      work_(std::move(job));
    }
  }

  std::function<void(Job&&)> work_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Job> next_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace field_fusion
