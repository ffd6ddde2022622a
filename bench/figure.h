#pragma once
// What every benchmark shares: timing in turns, the median with its interval, and the figure lines.
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace field_fusion::bench {

/// [ms] of CPU time that this thread has used; other load on the machine does not count.
inline double threadMs() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// [MB] The most that this process has held so far, and what it holds now.
inline double peakMb() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}
inline double residentMb() {
  std::ifstream in("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  in >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

template <class Job>
double costMs(Job&& job) {
  const double start = threadMs();
  job();
  return threadMs() - start;
}

/// [ms] By the clock on the wall, of work that threads share.
template <class Job>
double wallMs(Job&& job) {
  const auto start = std::chrono::steady_clock::now();
  job();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2.0;
}

/// A median with the percentile bootstrap's 95 % interval (Efron 1979).
struct Figure {
  double value, low, high;
  std::size_t n;
};

inline Figure medianFigure(const std::vector<double>& values) {
  constexpr int kResamples = 2000;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> pick(0, values.size() - 1);
  std::vector<double> medians(kResamples), drawn(values.size());
  for (double& m : medians) {
    for (double& d : drawn) d = values[pick(random)];
    m = median(drawn);
  }
  std::sort(medians.begin(), medians.end());
  return {median(values), medians[kResamples / 40], medians[kResamples - 1 - kResamples / 40], values.size()};
}

/// The line that scripts read: "figure NAME VALUE UNIT n=.. ci=[..,..]"; a ratio's unit is "-".
inline void print(const std::string& name, const Figure& f, const char* unit) {
  std::printf("figure %s %.4g %s n=%zu ci=[%.4g,%.4g]\n", name.c_str(), f.value, unit, f.n, f.low, f.high);
}

/// Costs of two jobs run in turns (A B A B ...), after one run of each that is not counted.
struct Duel {
  std::vector<double> a, b;

  std::vector<double> ratios() const {
    std::vector<double> out;
    for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] / b[i]);
    return out;
  }
};

template <class A, class B>
Duel duel(int repeats, A&& a, B&& b) {
  a(), b();
  Duel out;
  for (int i = 0; i < repeats; ++i) {
    out.a.push_back(costMs(a));
    out.b.push_back(costMs(b));
  }
  return out;
}

template <class Job>
std::vector<double> costs(int repeats, Job&& job) {
  job();
  std::vector<double> out;
  for (int i = 0; i < repeats; ++i) out.push_back(costMs(job));
  return out;
}

}  // namespace field_fusion::bench
