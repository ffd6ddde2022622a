#include "field_fusion/core/cloud/dbscan_beta.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "field_fusion/core/cloud/dbscan.h"

namespace field_fusion::core {

const std::vector<int>& DbscanBeta::run(const Cloud& cloud, float epsilon, int min_points, double theta) {
  if (!(epsilon >= 0.01f) || min_points < 1 || !(theta >= 0.0 && theta < radians(90.0)))
    throw std::invalid_argument("DBSCAN with epsilon " + std::to_string(epsilon) + " m, min_points " +
                                std::to_string(min_points) + " and theta " + std::to_string(theta) +
                                " rad: at least 0.01 m, 1, and 0 to below pi / 2 are needed");
  radius2_ = epsilon * epsilon;
  same_depth_ = BetaTest(theta);
  grid_.build(cloud, cellSide(epsilon));
  grid_.link();
  core_.resize(grid_.pointCount());
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) {
    const IndexRange own = grid_.points(cell);
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i) core_[i] = isCore(cell, i, min_points);
  }
  sets_.reset(grid_.pointCount());
  whole_.resize(grid_.cellCount());
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) joinWithin(cell);
  for (std::size_t a = 0; a < grid_.cellCount(); ++a)
    for (const auto run : grid_.neighbours(a))
      for (std::size_t b = run.first; b < run.last && b < a; ++b) joinAcross(a, b);
  labels_.assign(cloud.size(), kNoise);
  labelPoints();
  return labels_;
}

float DbscanBeta::distance2(std::uint32_t i, std::uint32_t j) const {
  return squaredDistance(grid_.xs()[i], grid_.ys()[i], grid_.zs()[i], grid_.xs()[j], grid_.ys()[j],
                         grid_.zs()[j]);
}

bool DbscanBeta::neighbours(std::uint32_t i, std::uint32_t j) const {
  return distance2(i, j) <= radius2_ && same_depth_(depthStep(position(i), position(j)));
}

/// Cells that follow each other hold points that follow each other.
IndexRange DbscanBeta::extent(CellGrid::Run run) const {
  const IndexRange last = grid_.points(run.last - 1);
  const std::uint32_t first = grid_.points(run.first).first;
  return {first, last.first + last.count - first};
}

bool DbscanBeta::isCore(std::size_t cell, std::uint32_t point, int min_points) const {
  int count = 0;
  for (const auto run : grid_.neighbours(cell)) {
    const auto [first, size] = extent(run);
    for (std::uint32_t i = first; i < first + size; ++i)
      if (neighbours(point, i) && ++count >= min_points) return true;
  }
  return false;
}

// Ends early once all points so far are one set: a heap of equal points costs one test each.
void DbscanBeta::joinWithin(std::size_t cell) {
  const auto [first, count] = grid_.points(cell);
  int parts = 0;
  for (std::uint32_t i = first; i < first + count; ++i) {
    if (!core_[i]) continue;
    ++parts;
    for (std::uint32_t j = i; j-- > first && parts > 1;) {
      if (!core_[j] || sets_.root(i) == sets_.root(j) || !neighbours(i, j)) continue;
      sets_.join(i, j);
      --parts;
    }
  }
  whole_[cell] = parts <= 1;
}

void DbscanBeta::joinAcross(std::size_t a, std::size_t b) {
  const bool one_is_enough = whole_[a] && whole_[b];
  const IndexRange in_a = grid_.points(a), in_b = grid_.points(b);
  for (std::uint32_t i = in_a.first; i < in_a.first + in_a.count; ++i) {
    if (!core_[i]) continue;
    for (std::uint32_t j = in_b.first; j < in_b.first + in_b.count; ++j) {
      if (!core_[j]) continue;
      const bool joined = sets_.root(i) == sets_.root(j);
      if (!joined && !neighbours(i, j)) continue;
      if (!joined) sets_.join(i, j);
      if (one_is_enough) return;
    }
  }
}

void DbscanBeta::labelPoints() {
  const auto count = static_cast<std::uint32_t>(grid_.pointCount());
  core_label_.resize(count);
  cluster_count_ = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!core_[i]) continue;
    const std::uint32_t lowest = sets_.root(i);  // has its label already, or is i
    core_label_[i] = lowest == i ? cluster_count_++ : core_label_[lowest];
  }
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) {
    const IndexRange own = grid_.points(cell);
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i)
      labels_[grid_.index()[i]] = core_[i] ? core_label_[i] : borderLabel(cell, i);
  }
}

int DbscanBeta::borderLabel(std::size_t cell, std::uint32_t point) const {
  float nearest = std::numeric_limits<float>::infinity();
  std::uint32_t winner = 0;
  int label = kNoise;
  for (const auto run : grid_.neighbours(cell)) {
    const auto [first, count] = extent(run);
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (!core_[i] || !neighbours(point, i)) continue;
      const float d = distance2(point, i);
      if (d > nearest || (d == nearest && grid_.index()[i] > winner)) continue;
      nearest = d, winner = grid_.index()[i], label = core_label_[i];
    }
  }
  return label;
}

}  // namespace field_fusion::core
