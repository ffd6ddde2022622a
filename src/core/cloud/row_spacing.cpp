#include "field_fusion/core/cloud/row_spacing.h"

#include <algorithm>
#include <cmath>

#include "field_fusion/core/cloud/cell_grid.h"

namespace field_fusion::core {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kSlack = 1.2;  // rows are neither level nor evenly spaced

}  // namespace

double RowSpacing::measure(const Cloud& cloud) {
  rows_.clear();
  for (const Point& p : cloud) {
    const float flat = std::sqrt(p.x * p.x + p.y * p.y);
    if (p.ring == kUnknownRing || !usable(p) || flat == 0.f) continue;
    if (p.ring >= rows_.size()) rows_.resize(p.ring + 1u, {kInfinity, -kInfinity});
    Row& row = rows_[p.ring];
    row.low = std::min(row.low, p.z / flat);
    row.high = std::max(row.high, p.z / flat);
  }
  gaps_.clear();
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
    const Row &below = rows_[i], &above = rows_[i + 1];
    if (below.low > below.high || above.low > above.high) continue;
    const auto middle = [](const Row& row) { return 0.5 * (std::atan(row.low) + std::atan(row.high)); };
    gaps_.push_back(std::abs(middle(above) - middle(below)));
  }
  if (gaps_.empty()) return 0.0;
  const auto median = gaps_.begin() + static_cast<std::ptrdiff_t>(gaps_.size() / 2);
  std::nth_element(gaps_.begin(), median, gaps_.end());
  return *median;
}

void RowSpacing::close(const Cloud& cloud, double gap, double epsilon, Cloud& out) {
  out = cloud;
  const auto start = static_cast<float>(epsilon / (kSlack * gap));  // [m] infinite without rows
  for (Point& p : out) {
    const float range = p.position().norm();
    if (range > start) p.z *= start / range;
  }
}

}  // namespace field_fusion::core
