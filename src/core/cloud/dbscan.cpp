#include "field_fusion/core/cloud/dbscan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

/// How many of n points are within sqrt(radius2) of (x, y, z); stops once `enough` are.
std::uint32_t countNear(float x, float y, float z, const float* xs, const float* ys, const float* zs,
                        std::uint32_t n, float radius2, std::uint32_t enough) {
  constexpr std::uint32_t kBlock = 32;  // long enough for vector code, short enough to stop early
  std::uint32_t count = 0;
  for (std::uint32_t begin = 0; begin < n && count < enough; begin += kBlock) {
    const std::uint32_t end = std::min(n, begin + kBlock);
    for (std::uint32_t i = begin; i < end; ++i)
      count += squaredDistance(x, y, z, xs[i], ys[i], zs[i]) <= radius2;
  }
  return count;
}

float gap(float a_low, float a_high, float b_low, float b_high) {
  return std::max(0.f, std::max(a_low - b_high, b_low - a_high));
}

}  // namespace

// A little smaller than epsilon / sqrt(3): rounding of places and distances (below 1e-6 of a cell) must
// never put two points into one cell that are not neighbours.
double cellSide(float epsilon) { return double{epsilon} / std::sqrt(3.0) * (1.0 - 1e-5); }

const std::vector<int>& Dbscan::run(const Cloud& cloud, float epsilon, int min_points) {
  if (!(epsilon >= 0.01f) || min_points < 1)
    throw std::invalid_argument("DBSCAN with epsilon " + std::to_string(epsilon) + " m and min_points " +
                                std::to_string(min_points) + ": at least 0.01 m and 1 are needed");
  radius2_ = epsilon * epsilon;
  return label(cloud, cellSide(epsilon), static_cast<std::uint32_t>(min_points));
}

// PCL's search leaves out what lies exactly at the tolerance: the limit is the next float below.
const std::vector<int>& Dbscan::runEuclidean(const Cloud& cloud, float tolerance) {
  if (!(tolerance >= 0.01f))
    throw std::invalid_argument("Euclidean clusters with tolerance " + std::to_string(tolerance) +
                                " m: at least 0.01 m is needed");
  radius2_ = std::nextafter(tolerance * tolerance, 0.f);
  return label(cloud, cellSide(tolerance), 1);
}

const std::vector<int>& Dbscan::label(const Cloud& cloud, double side, std::uint32_t min_points) {
  grid_.build(cloud, side);
  grid_.link();  // epsilon is just over sqrt(3) cells, so it ends within the second cell
  markCores(min_points);
  collectCores();
  joinCells();
  numberClusters();
  labels_.assign(cloud.size(), kNoise);
  labelPoints(labels_);
  return labels_;
}

void Dbscan::markCores(std::uint32_t min_points) {
  core_.assign(grid_.pointCount(), 0);
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) {
    const IndexRange own = grid_.points(cell);
    if (own.count >= min_points)
      std::fill_n(core_.begin() + own.first, own.count, 1);
    else
      markCoresOf(cell, min_points);
  }
}

void Dbscan::markCoresOf(std::size_t cell, std::uint32_t min_points) {
  const auto extent = [&](CellGrid::Run run) {
    const IndexRange last = grid_.points(run.last - 1);
    const std::uint32_t first = grid_.points(run.first).first;
    return IndexRange{first, last.first + last.count - first};
  };
  std::uint32_t reachable = 0;
  for (const auto run : grid_.neighbours(cell)) reachable += extent(run).count;
  if (reachable < min_points) return;

  const float *xs = grid_.xs(), *ys = grid_.ys(), *zs = grid_.zs();
  const IndexRange own = grid_.points(cell);
  for (std::uint32_t i = own.first; i < own.first + own.count; ++i) {
    std::uint32_t missing = min_points;
    for (const auto run : grid_.neighbours(cell)) {
      const auto [first, count] = extent(run);
      const std::uint32_t near =
          countNear(xs[i], ys[i], zs[i], xs + first, ys + first, zs + first, count, radius2_, missing);
      missing -= std::min(missing, near);
      if (missing == 0) break;
    }
    core_[i] = missing == 0;
  }
}

void Dbscan::collectCores() {
  core_x_.clear(), core_y_.clear(), core_z_.clear(), core_index_.clear();
  core_start_.assign(1, 0);
  core_box_.resize(grid_.cellCount());
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    Box box{{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};
    const IndexRange own = grid_.points(cell);
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i) {
      if (!core_[i]) continue;
      const std::array<float, 3> p{grid_.xs()[i], grid_.ys()[i], grid_.zs()[i]};
      core_x_.push_back(p[0]), core_y_.push_back(p[1]), core_z_.push_back(p[2]);
      core_index_.push_back(grid_.index()[i]);
      for (int k = 0; k < 3; ++k)
        box.low[k] = std::min(box.low[k], p[k]), box.high[k] = std::max(box.high[k], p[k]);
    }
    core_box_[cell] = box;
    core_start_.push_back(static_cast<std::uint32_t>(core_x_.size()));
  }
}

void Dbscan::joinCells() {
  const auto count = static_cast<std::uint32_t>(grid_.cellCount());
  sets_.reset(count);
  for (std::uint32_t a = 0; a < count; ++a) {
    if (core_start_[a] == core_start_[a + 1]) continue;
    for (const auto run : grid_.neighbours(a))
      for (std::uint32_t b = run.first; b < std::min(run.last, a); ++b)
        if (sets_.root(a) != sets_.root(b) && linked(a, b)) sets_.join(a, b);
  }
}

// Rounding is monotonic, so the boxes' gap in float arithmetic never exceeds that of any two points.
bool Dbscan::linked(std::size_t a, std::size_t b) const {
  const auto apart = [this](const Box& p, const Box& q) {
    return !(squaredDistance(gap(p.low[0], p.high[0], q.low[0], q.high[0]),
                             gap(p.low[1], p.high[1], q.low[1], q.high[1]),
                             gap(p.low[2], p.high[2], q.low[2], q.high[2]), 0.f, 0.f, 0.f) <= radius2_);
  };
  if (apart(core_box_[a], core_box_[b])) return false;
  const std::uint32_t first = core_start_[b], count = core_start_[b + 1] - first;
  for (std::uint32_t i = core_start_[a]; i < core_start_[a + 1]; ++i) {
    const std::array<float, 3> p{core_x_[i], core_y_[i], core_z_[i]};
    if (!apart({p, p}, core_box_[b]) && countNear(p[0], p[1], p[2], &core_x_[first], &core_y_[first],
                                                  &core_z_[first], count, radius2_, 1) > 0)
      return true;
  }
  return false;
}

void Dbscan::numberClusters() {
  cell_label_.assign(grid_.cellCount(), kNoise);
  cluster_count_ = 0;
  for (std::uint32_t cell = 0; cell < grid_.cellCount(); ++cell) {
    if (core_start_[cell] == core_start_[cell + 1]) continue;
    const std::uint32_t top =
        sets_.root(cell);  // the lowest cell of its cluster, so it has its label already
    cell_label_[cell] = top == cell ? cluster_count_++ : cell_label_[top];
  }
}

void Dbscan::labelPoints(std::vector<int>& labels) const {
  for (std::size_t cell = 0; cell < grid_.cellCount(); ++cell) {
    const IndexRange own = grid_.points(cell);
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i)
      labels[grid_.index()[i]] = core_[i] ? cell_label_[cell] : borderLabel(cell, i);
  }
}

int Dbscan::borderLabel(std::size_t cell, std::uint32_t point) const {
  const float x = grid_.xs()[point], y = grid_.ys()[point], z = grid_.zs()[point];
  float nearest = radius2_;
  std::uint32_t winner = std::numeric_limits<std::uint32_t>::max();
  int label = kNoise;
  for (const auto run : grid_.neighbours(cell))
    for (std::uint32_t other = run.first; other < run.last; ++other)
      for (std::uint32_t i = core_start_[other]; i < core_start_[other + 1]; ++i) {
        const float d = squaredDistance(x, y, z, core_x_[i], core_y_[i], core_z_[i]);
        if (d > nearest || (d == nearest && core_index_[i] > winner)) continue;
        nearest = d, winner = core_index_[i], label = cell_label_[other];
      }
  return label;
}

}  // namespace field_fusion::core
