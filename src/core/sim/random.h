#pragma once
// Random numbers that are a function of a seed and a place in a row, the same on every machine.
#include <cstdint>

namespace field_fusion::core::sim {

/// SplitMix64's finaliser: every bit of the result depends on every bit of the input.
inline std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Evenly spread in [0, 1).
inline double unitHash(std::uint64_t seed, std::uint64_t place) {
  return static_cast<double>(mixed(mixed(seed) + place) >> 11) * 0x1p-53;
}

}  // namespace field_fusion::core::sim
