#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "field_fusion/core/sim/ride.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kPi = radians(180.0);
constexpr std::size_t kRipples = 48;  // plane waves that make up a rough ground

struct Ripple {
  double kx, ky, phase;  // [rad/m], [rad/m], [rad]
};
using Ripples = std::array<Ripple, kRipples>;

/// Wave lengths from 2 to 5 grains (a bump is half of one), in all directions.
Ripples drawRipples(unsigned seed, double grain) {
  Ripples ripples;
  std::mt19937_64 random(seed);
  const auto draw = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };  // in [0, 1)
  for (std::size_t i = 0; i < kRipples; ++i) {
    const double length = 2 * grain * std::pow(2.5, (i + draw()) / kRipples);
    const double heading = 2 * kPi * draw();
    const double k = 2 * kPi / length;
    ripples[i] = {k * std::cos(heading), k * std::sin(heading), 2 * kPi * draw()};
  }
  return ripples;
}

/// The last rough ground asked for is kept: a height field asks a million times.
const Ripples& ripplesOf(unsigned seed, double grain) {
  struct Kept {
    unsigned seed = 0;
    double grain = 0.0;  // of no ground
    Ripples ripples;
  };
  thread_local Kept kept;
  if (kept.seed != seed || kept.grain != grain) kept = {seed, grain, drawRipples(seed, grain)};
  return kept.ripples;
}

double rough(const Ground& ground, double x, double y) {
  double sum = 0.0;
  for (const Ripple& ripple : ripplesOf(ground.seed, ground.grain))
    sum += std::sin(ripple.kx * x + ripple.ky * y + ripple.phase);
  return ground.roughness * std::sqrt(2.0 / kRipples) * sum;
}

double water(const std::vector<Wave>& waves, double x, double y, double time) {
  double sum = 0.0;
  for (const Wave& wave : waves) {
    const double k = 2 * kPi / wave.length;
    const double along = x * std::cos(wave.heading) + y * std::sin(wave.heading);
    sum += wave.amplitude * std::cos(k * along - std::sqrt(kGravity * k) * time + wave.phase);
  }
  return sum;
}

/// Mean height and slopes, along the body's x and y, of the ground below a footprint.
struct Footing {
  double height = 0.0, rise_x = 0.0, rise_y = 0.0;
};

Footing footing(const Ground& ground, const Transform& T_world_way, double length, double width,
                double time) {
  constexpr int kSide = 2;  // samples to each side of the middle
  Footing out;
  double moment_x = 0.0, moment_y = 0.0;
  for (int i = -kSide; i <= kSide; ++i)
    for (int j = -kSide; j <= kSide; ++j) {
      const double x = i * length / (2 * kSide + 1), y = j * width / (2 * kSide + 1);
      const Eigen::Vector3d p = T_world_way * Eigen::Vector3d(x, y, 0.0);
      const double z = ground.height(p.x(), p.y(), time);
      out.height += z;
      out.rise_x += x * z, moment_x += x * x;
      out.rise_y += y * z, moment_y += y * y;
    }
  constexpr int kSamples = (2 * kSide + 1) * (2 * kSide + 1);
  return {out.height / kSamples, out.rise_x / moment_x, out.rise_y / moment_y};
}

Transform leaning(const Transform& T_world_way, const Footing& footing) {
  const Eigen::Vector3d ahead = Eigen::Vector3d(1, 0, footing.rise_x).normalized();
  const Eigen::Vector3d up = Eigen::Vector3d(-footing.rise_x, -footing.rise_y, 1).normalized();
  Transform T_level_body = Transform::Identity();
  T_level_body.linear() << ahead, up.cross(ahead), up;
  Transform out = T_world_way * T_level_body;
  out.translation().z() += footing.height;
  return out;
}

}  // namespace

double Ground::height(double x, double y, double time) const {
  switch (kind) {
    case Kind::kNone:
      return kNaN;
    case Kind::kPlane:
      return slope.dot(Eigen::Vector2d(x, y));
    case Kind::kRough:
      return slope.dot(Eigen::Vector2d(x, y)) + rough(*this, x, y);
    case Kind::kWater:
      return water(waves, x, y, time);
  }
  return kNaN;
}

Trajectory carriedByGround(const Trajectory& way, const Ground& ground, Ride ride, double length,
                           double width) {
  const bool water = ground.kind == Ground::Kind::kWater;
  if (ground.kind == Ground::Kind::kNone || (water && ride != Ride::kFloating)) return way;
  const bool moves = ride == Ride::kFloating && !ground.waves.empty();
  const double least = 0.1;  // [m] a footprint has two directions
  length = std::max(length, least), width = std::max(width, least);
  return way.carriedBy(
      [=](const Transform& T_world_way, double time) {
        const double at = ride == Ride::kFloating ? time : 0.0;
        const Eigen::Vector3d p = T_world_way.translation();
        if (ride != Ride::kUpright)
          return leaning(T_world_way, footing(ground, T_world_way, length, width, at));
        Transform out = T_world_way;
        out.translation().z() += ground.height(p.x(), p.y(), at);
        return out;
      },
      moves);
}

}  // namespace field_fusion::core::sim
