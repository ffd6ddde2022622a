#pragma once
#include <cmath>
#include <cstdint>

namespace field_fusion::core {

inline float logOddsOf(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

/// The probability as cells of Occupancy have it.
inline std::int8_t percentOf(float log_odds) {
  return static_cast<std::int8_t>(std::lround(100.0 / (1.0 + std::exp(-static_cast<double>(log_odds)))));
}

}  // namespace field_fusion::core
