#pragma once
#include <atomic>
#include <thread>
#include <vector>

namespace field_fusion::core::sim {

/// How many threads a parameter `threads` means; 0: as many as cores.
inline int workersOf(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// job(row, worker) for all rows; workers take the next row when they are done with one, for sky costs less
/// than boats. A job must not depend on its worker but for scratch memory, and must not throw.
template <class Job>
void overRows(int rows, int workers, const Job& job) {
  std::atomic<int> next{0};
  const auto work = [&](int worker) {
    for (int row = next++; row < rows; row = next++) job(row, worker);
  };
  std::vector<std::thread> others;
  for (int w = 1; w < workers; ++w) others.emplace_back(work, w);
  work(0);
  for (std::thread& other : others) other.join();
}

}  // namespace field_fusion::core::sim
