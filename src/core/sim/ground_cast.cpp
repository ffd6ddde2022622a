#include "ground_cast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostFours = 8;
constexpr double kEnough = 1e-6;  // relative: the next step would be its square
constexpr double kGrazing = 0.05;
constexpr double kHorizon = 2e4;  // [m] no sensor sees water from farther

/// To within half a turn of 0; the large number makes the sum lose what is behind the point.
Eigen::Array4f reduced(const Eigen::Array4d& phase) {
  constexpr double kTurn = 2 * 3.14159265358979323846, kRound = 6755399441055744.0;
  const Eigen::Array4d turns = (phase * (1.0 / kTurn) + kRound) - kRound;
  return (phase - turns * kTurn).cast<float>();
}

struct Sines {
  Eigen::Array4d sine, cosine;
};

Sines quickSines(const Eigen::Array4d& phase) {
  const Eigen::Array4f rest = reduced(phase);
  const Eigen::Array4f sine = rest.sin(), cosine = rest.cos();  // four at once: a cast inside would end that
  return {sine.cast<double>(), cosine.cast<double>()};
}

double rangeToPlane(const Line& line, const Eigen::Vector2d& slope) {
  const double above = line.origin.z() - slope.dot(line.origin.head<2>());
  const double rate = line.direction.z() - slope.dot(line.direction.head<2>());
  const double t = -above / rate;
  return t > 0.0 ? t : kFar;
}

}  // namespace

/// Height above the water along a line, and how fast it grows.
struct Water::Along {
  struct Slope {
    double value, rate;
  };
  struct Phases {
    Eigen::Array4d start, rate, amplitude;
  };
  const Line& line;
  std::array<Phases, kMostFours> phases;
  std::size_t count;

  Along(const Line& l, const std::vector<Four>& fours, double time) : line(l), count(fours.size()) {
    const Eigen::Vector3d &o = l.origin, &d = l.direction;
    for (std::size_t i = 0; i < count; ++i) {
      const Four& w = fours[i];
      phases[i] = {w.kx * o.x() + w.ky * o.y() - w.omega * time + w.phase, w.kx * d.x() + w.ky * d.y(),
                   w.amplitude};
    }
  }
  /// `fine`: sines in double precision, ten times slower.
  Slope at(double t, bool fine = false) const {
    Slope out{line.origin.z() + t * line.direction.z(), line.direction.z()};
    for (std::size_t i = 0; i < count; ++i) {
      const Phases& w = phases[i];
      const Eigen::Array4d phase = w.start + t * w.rate;
      const Sines s = fine ? Sines{phase.sin(), phase.cos()} : quickSines(phase);
      out.value -= (w.amplitude * s.cosine).sum();
      out.rate += (w.amplitude * w.rate * s.sine).sum();
    }
    return out;
  }
};

Water::Water(const std::vector<Wave>& waves) : fours_((waves.size() + 3) / 4) {
  if (fours_.size() > kMostFours) throw std::invalid_argument("water has more than 32 waves");
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

Span Water::band(const Line& line) const {
  const double z = line.origin.z(), down = line.direction.z();
  const double a = (highest_ - z) / down, b = (-highest_ - z) / down;  // infinite or NaN along the water
  if (std::abs(z) <= highest_) return {0.0, std::isfinite(a) && std::isfinite(b) ? std::max(a, b) : kFar};
  return a > 0.0 ? Span{std::min(a, b), std::max(a, b)} : Span{kFar, kFar};
}

Span Water::bounds(const Line& line) const {
  const Span inside = band(line);
  return {inside.enter, inside.enter > 0.0 ? inside.leave : kFar};
}

/// Newton's steps to the one place where the line meets the water, from near it. Where it meets it at a
/// grazing angle, an error of the sines would move that place far.
double Water::polish(const Along& along, double t, double bend) {
  bool fine = false;
  for (int i = 0; i < 20; ++i) {
    const Along::Slope f = along.at(t, fine);
    const double step = -f.value / f.rate;
    t += step;
    if (bend * step * step > std::abs(f.rate) * kEnough * (1.0 + t)) continue;  // twice what is left
    if (fine || std::abs(f.rate) > kGrazing) return t;
    fine = true;
  }
  return t;
}

/// Steps that cannot pass the surface: within a step s the height over the water, f, falls by at most
/// s (largest slope), and by at most s |f'| + s^2 / 2 (largest bend); where it must fall to 0 by the same
/// bound with the other sign, it does so once.
double Water::range(const Line& line, double time) const {
  const double flat = line.direction.head<2>().norm();
  const double lipschitz = std::abs(line.direction.z()) + steepest_ * flat, bend = bend_ * flat * flat;
  const Span inside = band(line);
  double t = inside.enter;
  if (!(t < kHorizon)) return kFar;
  const Along along(line, fours_, time);
  Along::Slope f = along.at(t);
  const bool from_above = f.value > 0.0;
  for (int i = 0; i < 200 && t < kHorizon; ++i, f = along.at(t)) {
    if ((f.value > 0.0) != from_above) return t;  // rounding has carried it through
    const double height = std::abs(f.value), fall = std::max(0.0, from_above ? -f.rate : f.rate);
    if (fall * fall > 2.0 * bend * height) return polish(along, t + height / fall, bend);
    const double root = std::sqrt(fall * fall + 2.0 * bend * height);
    const double step = std::max(height / lipschitz, root > 0.0 ? 2.0 * height / (fall + root) : 0.0);
    t += step;
    if (t > inside.leave + kEnough) return kFar;
    if (step < kEnough * (1.0 + t)) return t;
  }
  return kFar;
}

Eigen::Vector3d Water::normal(double x, double y, double time) const {
  Eigen::Vector3d up(0, 0, 1);
  for (const Four& w : fours_) {
    const Eigen::Array4f sine = reduced(w.kx * x + w.ky * y - w.omega * time + w.phase).sin();
    const Eigen::Array4d steep = w.amplitude * sine.cast<double>();
    up.x() += (w.kx * steep).sum(), up.y() += (w.ky * steep).sum();
  }
  return up.normalized();
}

double GroundCast::range(const Line& line, double time) const {
  if (ground_.kind == Ground::Kind::kPlane) return rangeToPlane(line, ground_.slope);
  return ground_.kind == Ground::Kind::kWater ? water_.range(line, time) : kFar;
}

Span GroundCast::bounds(const Line& line) const {
  if (ground_.kind == Ground::Kind::kWater) return water_.bounds(line);
  const double exact = range(line, 0.0);
  return {exact, exact};
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
