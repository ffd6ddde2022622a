#pragma once
#include <algorithm>
#include <thread>
#include <vector>

namespace field_fusion::core::sim {

/// job(first, last) for parts of 0 .. count - 1, at once in `threads` threads; 0: as many as cores. What is
/// computed must not depend on the parts. An exception of a job ends the program, so it must not throw.
template <class Job>
void inParallel(std::size_t count, int threads, const Job& job) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t parts =
      std::min<std::size_t>(threads > 0 ? threads : cores, std::max<std::size_t>(1, count));
  std::vector<std::thread> others;
  for (std::size_t p = 1; p < parts; ++p)
    others.emplace_back([&, p] { job(count * p / parts, count * (p + 1) / parts); });
  job(std::size_t{0}, count / parts);
  for (std::thread& other : others) other.join();
}

}  // namespace field_fusion::core::sim
