#pragma once
#include <array>
#include <cstdint>
#include <limits>

namespace field_fusion::core {

/// Histogram of durations from 1 us to 100 s in bins 5 % wide; constant memory, no allocation.
class Latency {
 public:
  /// A duration that is negative or not finite counts as zero.
  void add(double seconds);
  /// Upper edge [s] of the bin in which the share `p` (0..1] of the durations ends; NaN when empty.
  double percentile(double p) const;
  double max() const { return max_; }  ///< [s], exact; NaN when empty
  std::uint64_t count() const { return count_; }

 private:
  static constexpr int kBins = 380;  // 1 us * 1.05^379 > 100 s
  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double max_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace field_fusion::core
