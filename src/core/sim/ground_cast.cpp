#include "ground_cast.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kHorizon = 2e4;  // [m] no sensor sees water from farther

/// To within half a turn of 0; the large number makes the sum lose what is behind the point.
Eigen::Array4f reduced(const Eigen::Array4d& phase) {
  constexpr double kTurn = 2 * 3.14159265358979323846, kRound = 6755399441055744.0;
  const Eigen::Array4d turns = (phase * (1.0 / kTurn) + kRound) - kRound;
  return (phase - turns * kTurn).cast<float>();
}

double rangeToPlane(const Line& line, const Eigen::Vector2d& slope) {
  const double above = line.origin.z() - slope.dot(line.origin.head<2>());
  const double rate = line.direction.z() - slope.dot(line.direction.head<2>());
  const double t = -above / rate;
  return t > 0.0 ? t : kFar;
}

}  // namespace

Water::Water(const std::vector<Wave>& waves) : fours_((waves.size() + 3) / 4) {
  for (Four& four : fours_)
    four.kx = four.ky = four.omega = four.phase = four.amplitude = Eigen::Array4d::Zero();
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const Wave& w = waves[i];
    Four& four = fours_[i / 4];
    const double k = radians(360.0) / w.length;
    const auto at = static_cast<Eigen::Index>(i % 4);
    four.kx[at] = k * std::cos(w.heading), four.ky[at] = k * std::sin(w.heading);
    four.omega[at] = std::sqrt(kGravity * k), four.phase[at] = w.phase, four.amplitude[at] = w.amplitude;
    highest_ += std::abs(w.amplitude);
    steepest_ += std::abs(w.amplitude) * k;
    bend_ += std::abs(w.amplitude) * k * k;
  }
}

Water::Slope Water::above(const Line& line, double time, double t) const {
  Slope out{line.origin.z() + t * line.direction.z(), line.direction.z()};
  for (const Four& w : fours_) {
    const Eigen::Array4d rate = w.kx * line.direction.x() + w.ky * line.direction.y();
    const Eigen::Array4d start = w.kx * line.origin.x() + w.ky * line.origin.y() - w.omega * time + w.phase;
    const Eigen::Array4f phase = reduced(start + t * rate);
    out.value -= (w.amplitude * phase.cos().cast<double>()).sum();
    out.rate += (w.amplitude * rate * phase.sin().cast<double>()).sum();
  }
  return out;
}

/// Steps that cannot pass the surface: within a step s the height over the water, f, falls by at most
/// s (largest slope) and by at most s |f'| + s^2 / 2 (largest bend). The second converges quadratically.
double Water::range(const Line& line, double time) const {
  const double z = line.origin.z(), down = line.direction.z(), flat = line.direction.head<2>().norm();
  double t = 0.0;
  if (std::abs(z) > highest_) {
    if (z * down >= 0.0) return kFar;
    t = (std::abs(z) - highest_) / std::abs(down);
  }
  const double lipschitz = std::abs(down) + steepest_ * flat, bend = bend_ * flat * flat;
  const bool from_above = above(line, time, t).value > 0.0;
  for (int i = 0; i < 200 && t < kHorizon; ++i) {
    const Slope f = above(line, time, t);
    if ((f.value > 0.0) != from_above) return t;  // rounding has carried it through
    if (std::abs(line.origin.z() + t * down) > highest_ && (z + t * down) * down > 0.0) return kFar;
    const double height = std::abs(f.value), fall = std::max(0.0, f.value > 0.0 ? -f.rate : f.rate);
    const double root = std::sqrt(fall * fall + 2.0 * bend * height);
    const double step = std::max(height / lipschitz, root > 0.0 ? 2.0 * height / (fall + root) : 0.0);
    t += step;
    if (step < 1e-7 * (1.0 + t)) return t;
  }
  return kFar;
}

Eigen::Vector3d Water::normal(double x, double y, double time) const {
  const double dx = above({{x, y, 0}, {1, 0, 0}}, time, 0.0).rate;
  const double dy = above({{x, y, 0}, {0, 1, 0}}, time, 0.0).rate;
  return Eigen::Vector3d(dx, dy, 1.0).normalized();
}

double GroundCast::range(const Line& line, double time) const {
  if (ground_.kind == Ground::Kind::kPlane) return rangeToPlane(line, ground_.slope);
  return ground_.kind == Ground::Kind::kWater ? water_.range(line, time) : kFar;
}

Eigen::Vector3d GroundCast::normal(const Eigen::Vector3d& at, double time) const {
  if (ground_.kind == Ground::Kind::kWater) return water_.normal(at.x(), at.y(), time);
  return Eigen::Vector3d(-ground_.slope.x(), -ground_.slope.y(), 1.0).normalized();
}

Mesh roughMesh(const Ground& ground) {
  const double width = 2.0 * ground.half_extent;
  const auto cells =
      static_cast<std::uint32_t>(std::clamp(std::ceil(width / (ground.grain / 8.0)), 1.0, 768.0));
  const std::uint32_t row = cells + 1;
  Mesh mesh;
  mesh.vertices.reserve(row * row), mesh.triangles.reserve(2 * cells * cells);
  for (std::uint32_t j = 0; j < row; ++j)
    for (std::uint32_t i = 0; i < row; ++i) {
      const double x = width * i / cells - ground.half_extent, y = width * j / cells - ground.half_extent;
      mesh.vertices.push_back(Eigen::Vector3d(x, y, ground.height(x, y, 0.0)).cast<float>());
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      mesh.triangles.push_back({a, b, d}), mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

}  // namespace field_fusion::core::sim
