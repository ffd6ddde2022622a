#include "field_fusion/core/base/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace field_fusion::core {

void Histogram::add(double value) {
  if (std::isnan(value)) return;
  const double last = static_cast<double>(counts_.size()) - 1.0;
  const double bin = std::clamp(std::floor((value - low_) / width_) + 1.0, 0.0, last);
  ++counts_[static_cast<std::size_t>(bin)];
  ++count_;
}

double Histogram::median() const {
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
    below += counts_[bin];
    if (2 * below < count_ || below == 0) continue;
    if (bin == 0) return low_;
    return low_ + width_ * (static_cast<double>(bin) - (bin + 1 == counts_.size() ? 1.0 : 0.5));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string Histogram::text(double scale) const {
  std::ostringstream out;
  const auto edge = [&](std::size_t bin) { return scale * (low_ + width_ * static_cast<double>(bin)); };
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
    if (counts_[bin] == 0) continue;
    if (out.tellp() > 0) out << ", ";
    if (bin == 0)
      out << "below " << edge(0);
    else if (bin + 1 == counts_.size())
      out << "above " << edge(bin - 1);
    else
      out << edge(bin - 1) << ".." << edge(bin);
    out << ": " << counts_[bin];
  }
  return out.str();
}

void Histogram::reset() {
  std::fill(counts_.begin(), counts_.end(), 0);
  count_ = 0;
}

}  // namespace field_fusion::core
