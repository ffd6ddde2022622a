#include "field_fusion/core/map/particle_weights.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {

std::vector<double> normalised(const std::vector<double>& log_weights) {
  const double n = static_cast<double>(log_weights.size());
  std::vector<double> out(log_weights.size(), 1.0 / n);
  double most = -HUGE_VAL, sum = 0.0;
  for (const double w : log_weights)
    if (std::isfinite(w)) most = std::max(most, w);
  if (!std::isfinite(most)) return out;
  for (std::size_t i = 0; i < out.size(); ++i)
    sum += out[i] = std::isfinite(log_weights[i]) ? std::exp(log_weights[i] - most) : 0.0;
  for (double& w : out) w /= sum;
  return out;
}

double effectiveNumber(const std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights) sum += w * w;
  return 1.0 / sum;
}

double entropy(const std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights)
    if (w > 0.0) sum -= w * std::log(w);
  return sum;
}

std::vector<std::size_t> resampled(const std::vector<double>& weights, double uniform) {
  const std::size_t n = weights.size();
  std::vector<std::size_t> out;
  double reached = weights.front();
  std::size_t from = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double at = (static_cast<double>(k) + uniform) / static_cast<double>(n);
    while (at >= reached && from + 1 < n) reached += weights[++from];
    out.push_back(from);
  }
  return out;
}

}  // namespace field_fusion::core
