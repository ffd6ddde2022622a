#pragma once
// Random numbers that are a function of a seed and a place in a row, the same on every machine.
#include "field_fusion/core/sim/beam_random.h"

namespace field_fusion::core::sim {

/// Evenly spread in [0, 1).
inline double unitHash(std::uint64_t seed, std::uint64_t place) {
  return static_cast<double>(mixed(mixed(seed + 1) + place) >> 11) * 0x1p-53;
}

}  // namespace field_fusion::core::sim
