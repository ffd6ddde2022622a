#include "field_fusion/core/base/latency.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr double kFirstEdge = 1e-6;  // [s]
const double kLogStep = std::log(1.05);

}  // namespace

void Latency::add(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) seconds = 0.0;
  const int bin =
      seconds <= kFirstEdge ? 0 : static_cast<int>(std::ceil(std::log(seconds / kFirstEdge) / kLogStep));
  ++bins_[std::clamp(bin, 0, kBins - 1)];
  max_ = count_ == 0 ? seconds : std::max(max_, seconds);
  ++count_;
}

double Latency::percentile(double p) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(p * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (int bin = 0; bin < kBins && count_ > 0; ++bin) {
    seen += bins_[bin];
    if (seen >= wanted && seen > 0) return std::min(kFirstEdge * std::exp(kLogStep * bin), max_);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace field_fusion::core
