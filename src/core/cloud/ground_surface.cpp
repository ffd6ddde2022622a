#include "field_fusion/core/cloud/ground_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace field_fusion::core {
namespace {

constexpr int kHalfSide = GroundSurface::kHalfSide;
constexpr int kSide = 2 * kHalfSide;
constexpr int kCells = kSide * kSide;

/// Cells that touch the sensor's foot.
constexpr std::uint32_t kMiddleCells = 4;

/// [m] Corridor about the plane at the sensor's foot; it widens with the distance.
constexpr float kCorridor = 0.1f;

/// Fewest points that show a cell's ground.
constexpr std::uint32_t kFewest = 3;

/// [m] So far above and below the ground expected, points speak against it.
constexpr float kAround = 1.f;

/// Share of an unexpected rise that is taken for a change of slope; the rest is noise, or a step.
constexpr float kSlopeGain = 0.5f;

/// Share of the slope that the next cell believes in: far from the last ground seen it is level again.
constexpr float kSlopeKept = 0.95f;

constexpr float kTicksPerMetre = 1e4f;

/// [m] Heights beyond this count as this, so that they fit in ticks.
constexpr double kHighest = 1000.0;

std::int32_t ticks(double height) {
  return static_cast<std::int32_t>(std::lround(std::clamp(height, -kHighest, kHighest) * kTicksPerMetre));
}

int cellAt(const Eigen::Vector2f& at) {
  constexpr float kLast = kSide - 1;
  const int column = static_cast<int>(std::clamp(at.x() + kHalfSide, 0.f, kLast));
  const int row = static_cast<int>(std::clamp(at.y() + kHalfSide, 0.f, kLast));
  return row * kSide + column;
}

Eigen::Vector2f middle(int cell) {
  return Eigen::Vector2f(cell % kSide, cell / kSide).array() + (0.5f - kHalfSide);
}

}  // namespace

GroundSurface::GroundSurface() : rank_(kCells), patches_(kCells) {
  std::vector<int> order(kCells);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [](int a, int b) { return middle(a).squaredNorm() < middle(b).squaredNorm(); });
  for (Rank rank = 0; rank < kCells; ++rank) rank_[order[rank]] = rank;
  for (const int cell : order) {
    const Eigen::Vector2f at = middle(cell);
    const auto first = static_cast<std::uint32_t>(inner_.size());
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const Eigen::Vector2f way(x, y), from = at - way;
        if (from.squaredNorm() < at.squaredNorm())
          inner_.push_back({rank_[cellAt(from)], 1.f / way.squaredNorm(), way});
      }
    cells_.push_back(
        {at.norm(), at.normalized(), {first, static_cast<std::uint32_t>(inner_.size()) - first}});
  }
}

void GroundSurface::measure(const Cloud& cloud, const std::vector<std::uint32_t>& usable, const Plane& plane,
                            const SurfaceLimits& limits, std::vector<double>& heights) {
  place(cloud, usable, plane, heights);
  sort(heights);
  grow(limits);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const Patch& patch = patches_[places_[k].rank];
    heights[k] -= patch.height + patch.slope.dot(places_[k].offset);
  }
}

void GroundSurface::place(const Cloud& cloud, const std::vector<std::uint32_t>& usable, const Plane& plane,
                          std::vector<double>& heights) {
  const Eigen::Vector3d u = plane.normal.unitOrthogonal();
  Eigen::Matrix<float, 2, 3> along;  // the plane's own axes
  along << u.transpose().cast<float>(), plane.normal.cross(u).transpose().cast<float>();
  heights.clear();
  places_.clear();
  for (const std::uint32_t i : usable) {
    const Eigen::Vector3f p = cloud[i].position();
    const Eigen::Vector2f at = along * p;
    const int cell = cellAt(at);
    heights.push_back(plane.height(p.cast<double>()));
    places_.push_back({rank_[cell], (at - middle(cell)).cwiseMax(-0.5f).cwiseMin(0.5f)});
  }
}

/// Counting sort.
void GroundSurface::sort(const std::vector<double>& heights) {
  start_.assign(kCells + 1, 0);
  for (const Place& p : places_) ++start_[p.rank];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  ticks_.resize(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) ticks_[--start_[places_[k].rank]] = ticks(heights[k]);
}

void GroundSurface::grow(const SurfaceLimits& limits) {
  const auto slope = static_cast<float>(std::tan(limits.slope)), step = static_cast<float>(limits.step);
  for (Rank rank = kMiddleCells; rank < kCells; ++rank) {
    Patch patch = settle(rank, step);
    const float corridor = kCorridor + slope * cells_[rank].distance, steepness = patch.slope.norm();
    patch.height = std::clamp(patch.height, -corridor, corridor);
    if (steepness > slope) patch.slope *= slope / steepness;
    patches_[rank] = patch;
  }
}

GroundSurface::Patch GroundSurface::settle(Rank rank, float step) const {
  const Cell& cell = cells_[rank];
  Patch patch = expected(cell, kSlopeKept);
  if (start_[rank + 1] - start_[rank] < kFewest) return patch;
  Sight seen = look(rank, patch.height, step);
  const auto consider = [&](const Patch& other) {
    const Sight there = look(rank, other.height, step);
    if (there.points > seen.points) patch = other, seen = there;
  };
  consider(expected(cell, 0.f));
  // From a bank or a pavement back down to the plane. Never up to it: that would be the way onto bodies.
  if (patch.height > 0.f) consider({0.f, {0.f, 0.f}, patch.gap});
  if (seen.points == 0) return patch;
  patch.height += seen.error;
  patch.slope += kSlopeGain * seen.error / patch.gap * cell.outward;
  patch.gap = 1.f;
  return patch;
}

/// Where the inner cells lead with that share of their slopes, 0 for level ground; the fresher a cell's own
/// knowledge, the more it counts.
GroundSurface::Patch GroundSurface::expected(const Cell& cell, float slope_kept) const {
  Patch sum{0.f, {0.f, 0.f}, 0.f};
  float weights = 0.f;
  for (std::uint32_t k = cell.inner.first; k < cell.inner.first + cell.inner.count; ++k) {
    const Inner& inner = inner_[k];
    const Patch& from = patches_[inner.rank];
    const float weight = inner.weight / (from.gap * from.gap);
    sum.height += weight * (from.height + slope_kept * from.slope.dot(inner.way));
    sum.slope += weight * slope_kept * from.slope;
    sum.gap += weight * from.gap;
    weights += weight;
  }
  return {sum.height / weights, sum.slope / weights, sum.gap / weights + 1.f};
}

/// The points within the step of a height [m]; none where they are too few or outnumbered.
GroundSurface::Sight GroundSurface::look(Rank rank, float height, float step) const {
  const std::int32_t level = ticks(height), near = ticks(step), around = ticks(kAround);
  std::int64_t sum = 0;
  std::uint32_t on = 0, off = 0;
  for (std::uint32_t k = start_[rank]; k < start_[rank + 1]; ++k) {
    const std::int32_t above = ticks_[k] - level, distance = std::abs(above);
    if (distance <= near)
      sum += above, ++on;
    else if (distance <= around)
      ++off;
  }
  if (on < kFewest || on < off) return {};
  return {on, static_cast<float>(sum) / (kTicksPerMetre * static_cast<float>(on))};
}

}  // namespace field_fusion::core
