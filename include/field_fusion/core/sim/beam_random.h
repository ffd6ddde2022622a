#pragma once
// Seeds of sensors, scans and frames; each beam or pixel has a sequence of its own.
#include <cstring>
#include <string>

#include "field_fusion/core/base/counter_random.h"

namespace field_fusion::core::sim {

using BeamRandom = CounterRandom;

/// A sensor's own seed from that of the run and its name (FNV-1a), so that two sensors do not err alike.
inline std::uint64_t seedOf(std::uint64_t run, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return mixed(hash + mixed(run + 1));
}

/// Seed of one scan or frame, told apart by its stamp [s].
inline std::uint64_t seedOf(std::uint64_t sensor, double stamp) {
  std::uint64_t bits;
  std::memcpy(&bits, &stamp, sizeof bits);
  return mixed(sensor ^ mixed(bits + 1));
}

}  // namespace field_fusion::core::sim
