#pragma once
// Random numbers that depend on what they are for, not on who asks first: a beam's noise or a particle's draw
// follows from a seed and its place, whatever the number of threads.
#include <cmath>
#include <cstdint>

namespace field_fusion::core {

/// 64 well mixed bits of a counter (SplitMix64; Steele, Lea and Flood 2014).
inline std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

class CounterRandom {
 public:
  /// The sequence of the `index`-th beam, pixel or particle of what `seed` stands for.
  CounterRandom(std::uint64_t seed, std::uint64_t index) : state_(mixed(seed + index * kStep)) {}

  std::uint64_t bits() { return mixed(state_ += kStep); }
  /// In [0, 1).
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  /// Mean 0, sigma 1 (Box and Muller 1958).
  float normal() {
    if (spare_ready_) {
      spare_ready_ = false;
      return spare_;
    }
    const float radius = std::sqrt(-2.f * std::log(1.f - uniform()));
    const float angle = 6.2831853f * uniform();
    spare_ = radius * std::sin(angle);
    spare_ready_ = true;
    return radius * std::cos(angle);
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;
  std::uint64_t state_;
  float spare_ = 0.f;
  bool spare_ready_ = false;
};

}  // namespace field_fusion::core
