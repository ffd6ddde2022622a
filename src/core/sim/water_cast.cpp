#include "water_cast.h"

#include <limits>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostWaves = 32;
constexpr double kEnough = 1e-6;  // relative: the next step would be its square
constexpr double kHorizon = 2e4;  // [m] no sensor sees water from farther
constexpr double kTiny = 1e-300;
constexpr int kMostSteps = 200;

}  // namespace

/// Of eight lines. Flags are numbers, 1 or 0, so that all lanes are of one width.
struct WaterCast::Search {
  Lanes<double> start[kMostWaves], rate[kMostWaves];  ///< [rad], [rad/m] of each wave's phase along a line
  Lanes<double> lipschitz, bend;                      ///< bounds of the first and second derivative of height
  Lanes<double> leave;                                ///< [m] where a line leaves the highest band of water
  Lanes<double> side;                                 ///< 1: starts above the water, -1: below
  Lanes<double> t, height, slope;                     ///< [m], height over the water at t, its derivative
  Lanes<double> searching, close, met;
};

WaterCast::WaterCast(const std::vector<Wave>& waves) {
  if (waves.size() > kMostWaves) throw std::invalid_argument("water has more than 32 waves");
  for (const Wave& w : waves) {
    const double k = radians(360.0) / w.length;
    waves_.push_back({k * std::cos(w.heading), k * std::sin(w.heading), std::sqrt(kGravity * k), w.phase,
                      w.amplitude});
    highest_ += std::abs(w.amplitude);
    steepest_ += std::abs(w.amplitude) * k;
    bend_ += std::abs(w.amplitude) * k * k;
  }
}

FIELD_FUSION_LANES void WaterCast::bounds(const LineLanes& lines, BoundLanes& out) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double z = lines.origin[2][i], down = lines.direction[2][i];
    const double a = (highest_ - z) / down, b = (-highest_ - z) / down;  // infinite or NaN along the water
    const double first = lesser(a, b), last = greater(a, b), ahead = a > 0.0 ? first : kFar;
    const double behind = a > 0.0 ? last : kFar;
    out.enter[i] = std::abs(z) <= highest_ ? 0.0 : ahead;
    out.leave[i] = std::abs(z) <= highest_ ? kFar : behind;
  }
}

FIELD_FUSION_INLINE void WaterCast::begin(const LineLanes& lines, const Lanes<double>& wanted,
                                          Search& s) const {
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    const WaveNumbers& wave = waves_[w];
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double still = wave.kx * lines.origin[0][i] + wave.ky * lines.origin[1][i];
      s.start[w][i] = still - wave.omega * lines.time[i] + wave.phase;
      s.rate[w][i] = wave.kx * lines.direction[0][i] + wave.ky * lines.direction[1][i];
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = lines.direction[0][i], y = lines.direction[1][i], down = lines.direction[2][i];
    const double z = lines.origin[2][i], flat = std::sqrt(x * x + y * y);
    s.lipschitz[i] = std::abs(down) + steepest_ * flat, s.bend[i] = bend_ * flat * flat;
    const double a = (highest_ - z) / down, b = (-highest_ - z) / down;
    const double first = lesser(a, b), ahead = a > 0.0 ? first : kFar;
    const double enter = std::abs(z) <= highest_ ? 0.0 : ahead, last = greater(a, b);
    const double starts = enter < kHorizon ? wanted[i] : 0.0;
    s.leave[i] = down == 0.0 ? kFar : last;
    s.t[i] = starts > 0.0 ? enter : 0.0;
    s.searching[i] = starts, s.close[i] = s.met[i] = s.side[i] = 0.0;
  }
}

FIELD_FUSION_INLINE void WaterCast::look(const LineLanes& lines, Search& s) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    s.height[i] = lines.origin[2][i] + s.t[i] * lines.direction[2][i];
    s.slope[i] = lines.direction[2][i];
  }
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    const double amplitude = waves_[w].amplitude;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Sines of = sines(s.start[w][i] + s.t[i] * s.rate[w][i]);
      s.height[i] -= amplitude * of.cosine, s.slope[i] += amplitude * s.rate[w][i] * of.sine;
    }
  }
}

/// Steps that cannot pass the surface: within a step s the height over the water, f, falls by at most
/// s (largest slope), and by at most s |f'| + s^2 / 2 (largest bend); where it must fall to 0 by the same
/// bound with the other sign, it does so once, and Newton's steps lead there. Returns whether any goes on.
FIELD_FUSION_INLINE bool WaterCast::step(Search& s) {
  double any = 0.0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double t = s.t[i], f = s.height[i], slope = s.slope[i], bend = s.bend[i];
    const double first = f > 0.0 ? 1.0 : -1.0, side = s.side[i] == 0.0 ? first : s.side[i];
    const double height = std::abs(f), fall = greater(0.0, -side * slope);
    const double near = fall * fall - 2.0 * bend * height, newton = -f / slope;
    const double close = near > 0.0 ? 1.0 : s.close[i];
    const double root = std::sqrt(fall * fall + 2.0 * bend * height);
    const double sure = greater(height / s.lipschitz[i], 2.0 * height / greater(fall + root, kTiny));
    const double on = side * f < 0.0 ? 0.0 : sure;  // rounding has carried it through
    const double length = close > 0.0 ? newton : on;
    const double next = t + length, much = kEnough * (1.0 + next);
    // twice what is left after a step of Newton's
    const double rest = close > 0.0 ? bend * length * length / std::abs(slope) : length;
    const double end = close > 0.0 ? kFar : lesser(s.leave[i] + kEnough, kHorizon);
    const double searching = next > end ? 0.0 : s.searching[i];  // lost or not wanted: 0
    const double found = rest <= much ? searching : 0.0;
    s.t[i] = searching > 0.0 ? next : t;
    s.side[i] = side, s.close[i] = close;
    s.met[i] = found > 0.0 ? 1.0 : s.met[i];
    s.searching[i] = searching - found;
    any += searching - found;
  }
  return any > 0.0;
}

FIELD_FUSION_LANES void WaterCast::meet(const LineLanes& lines, const Lanes<double>& wanted,
                                        MeetingLanes& out) const {
  Search s;
  begin(lines, wanted, s);
  for (int i = 0; i < kMostSteps; ++i) {
    look(lines, s);
    if (!step(s)) break;
  }
  Lanes<double> x{}, y{};
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    const WaveNumbers& wave = waves_[w];
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double steep = wave.amplitude * sines(s.start[w][i] + s.t[i] * s.rate[w][i]).sine;
      x[i] -= wave.kx * steep, y[i] -= wave.ky * steep;
    }
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    out.range[i] = s.met[i] != 0.0 ? s.t[i] : kFar;
    out.slope_x[i] = x[i], out.slope_y[i] = y[i];
  }
}

}  // namespace field_fusion::core::sim
