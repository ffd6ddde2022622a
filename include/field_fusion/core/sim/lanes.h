#pragma once
// Eight things at a time: plain loops over eight numbers, which the compiler turns into vectors, as wide as
// the machine's. Nothing is rounded otherwise for that: the same bits come out on every machine.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// Of a function with such loops: compiled for several instruction sets, the best is chosen when the program
/// starts. Only what is inlined into it is compiled so, too.
#if defined(__x86_64__) && defined(__has_attribute)
#if __has_attribute(target_clones)
#define FIELD_FUSION_LANES __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
#endif
#ifndef FIELD_FUSION_LANES
#define FIELD_FUSION_LANES
#endif
/// Of a part of such a function.
#define FIELD_FUSION_INLINE inline __attribute__((always_inline))

namespace field_fusion::core::sim {

constexpr std::size_t kLanes = 8;

template <class T>
struct alignas(kLanes * sizeof(T)) Lanes {
  T of[kLanes];

  T& operator[](std::size_t lane) { return of[lane]; }
  const T& operator[](std::size_t lane) const { return of[lane]; }
};

FIELD_FUSION_INLINE double lesser(double a, double b) { return a < b ? a : b; }
FIELD_FUSION_INLINE double greater(double a, double b) { return a > b ? a : b; }
FIELD_FUSION_INLINE float lesser(float a, float b) { return a < b ? a : b; }
FIELD_FUSION_INLINE float greater(float a, float b) { return a > b ? a : b; }

struct Sines {
  double sine, cosine;
};

/// To 3e-10, for |angle| < 1e6 [rad]: polynomials of least greatest error within a quarter turn of 0.
FIELD_FUSION_INLINE Sines sines(double angle) {
  constexpr double kPi = 3.14159265358979323846, kRound = 6755399441055744.0;  // 1.5 * 2^52: drops fractions
  const double shifted = angle * (1.0 / kPi) + kRound;
  const double x = angle - (shifted - kRound) * kPi, x2 = x * x;
  std::uint64_t odd;
  std::memcpy(&odd, &shifted, sizeof odd);
  odd <<= 63;  // half turns: each swaps both signs
  const auto signedBy = [odd](double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    bits ^= odd;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  const double sine =
      x * (0.99999999988985 +
           x2 * (-0.16666666541439 +
                 x2 * (8.33332926445678e-3 +
                       x2 * (-1.98407028625773e-4 + x2 * (2.75188556376335e-6 - x2 * 2.37947135345627e-8)))));
  const double cosine =
      0.99999999978065 +
      x2 * (-0.49999999358472 +
            x2 * (0.04166663625807 +
                  x2 * (-1.38883614002472e-3 + x2 * (2.47601613512400e-5 - x2 * 2.60514951932321e-7))));
  return {signedBy(sine), signedBy(cosine)};
}

/// To 1e-6, as far as a float holds the angle.
FIELD_FUSION_INLINE float quickSine(float angle) {
  constexpr float kPi = 3.140625f, kRest = 9.67653590e-4f;  // pi in two, so that its multiples are exact
  constexpr float kRound = 12582912.f;                      // 1.5 * 2^23
  const float shifted = angle * (1.f / (kPi + kRest)) + kRound, turns = shifted - kRound;
  const float x = (angle - turns * kPi) - turns * kRest, x2 = x * x;
  float sine = x * (0.99999662f + x2 * (-0.16664828f + x2 * (8.3063252e-3f - x2 * 1.8363654e-4f)));
  std::uint32_t odd, bits;
  std::memcpy(&odd, &shifted, sizeof odd), std::memcpy(&bits, &sine, sizeof bits);
  bits ^= odd << 31;
  std::memcpy(&sine, &bits, sizeof sine);
  return sine;
}

}  // namespace field_fusion::core::sim
