#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace field_fusion::core {

/// Counts of values in bins of equal width, and in one bin below and one above them.
class Histogram {
 public:
  /// `bins` bins of `width` from `low` on.
  Histogram(double low, double width, int bins) : low_(low), width_(width), counts_(bins + 2) {}

  /// NaN is not counted.
  void add(double value);
  /// Middle of the bin that holds the median, the edge for the outer two; NaN when empty.
  double median() const;
  std::uint64_t count() const { return count_; }
  /// Every bin that holds something, values times `scale`: "0..5: 12, 5..10: 3, above 100: 1".
  std::string text(double scale) const;
  void reset();

 private:
  double low_, width_;
  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
};

}  // namespace field_fusion::core
