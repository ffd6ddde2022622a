#include "field_fusion/core/map/voxel_map.h"

#include <algorithm>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/map/log_odds.h"

namespace field_fusion::core {

VoxelMap::VoxelMap(const VoxelMapParams& params)
    : params_(checked(params)),
      lattice_(params.resolution),
      workers_(params.threads),
      marks_(workers_.number()),
      counted_(workers_.number()) {
  setLive(params);
}

void VoxelMap::setLive(const VoxelMapParams& params) {
  VoxelMapParams next = params;
  next.resolution = params_.resolution, next.threads = params_.threads;
  params_ = checked(next);
  hit_ = logOddsOf(params_.hit), miss_ = logOddsOf(params_.miss), occupied_ = logOddsOf(params_.occupied);
  min_ = logOddsOf(params_.clamp_min), max_ = logOddsOf(params_.clamp_max);
}

VoxelCounts VoxelMap::insert(const Cloud& cloud, const Transform& T_map_sensor) {
  points_.clear();
  for (const Point& point : cloud)
    points_.push_back((T_map_sensor * point.position().cast<double>()).cast<float>());
  return insert(points_, T_map_sensor.translation().cast<float>());
}

VoxelCounts VoxelMap::insert(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& sensor) {
  const auto at = lattice_.key(sensor);
  if (!at) return {0, 0, points.size(), 0, 0};
  for (VoxelMarks& marks : marks_) marks.begin(*at, params_.reach());
  workers_.share(marks_.size(),
                 [&](std::size_t part, int) { mark(points, sensor, part, marks_[part], counted_[part]); });
  VoxelCounts counts;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (i > 0) marks_[0].add(marks_[i]);
    counts.points += counted_[i].points, counts.far += counted_[i].far,
        counts.unusable += counted_[i].unusable;
  }
  update(counts);
  return counts;
}

void VoxelMap::mark(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& sensor,
                    std::size_t part, VoxelMarks& marks, VoxelCounts& counts) const {
  counts = {};
  const std::size_t first = points.size() * part / marks_.size(),
                    last = points.size() * (part + 1) / marks_.size();
  for (std::size_t i = first; i < last; ++i) {
    const Eigen::Vector3f way = points[i] - sensor;
    const double range =
        std::sqrt(static_cast<double>(way.x() * way.x() + way.y() * way.y() + way.z() * way.z()));
    const bool far = range > params_.max_range;
    const Eigen::Vector3f end = far ? Eigen::Vector3f(sensor + way / static_cast<float>(range) *
                                                                   static_cast<float>(params_.max_range))
                                    : points[i];
    const auto ray = std::isfinite(range) ? VoxelRay::between(lattice_, sensor, end) : std::nullopt;
    if (!ray) {
      ++counts.unusable;
      continue;
    }
    ++counts.points, counts.far += far;
    marks.pass(*ray);
    if (!far) marks.hit(ray->end);
  }
}

void VoxelMap::update(VoxelCounts& counts) {
  const VoxelMarks& marks = marks_[0];
  for (std::size_t i = 0; i < marks.size(); ++i) {
    VoxelCube& cube = store_.cube(marks.cube(i));
    const CubeBits free = marks.free(i);
    forEachBit(free, [&](int v) {
      cube.log_odds[v] = std::max(cube.log_odds[v] + miss_, min_);
      ++counts.free;
    });
    forEachBit(marks.hits(i), [&](int v) {
      cube.log_odds[v] = std::min(cube.log_odds[v] + hit_, max_);
      ++counts.occupied;
    });
    for (std::size_t w = 0; w < free.size(); ++w) cube.known[w] |= free[w] | marks.hits(i)[w];
  }
}

float VoxelMap::logOdds(const VoxelKey& voxel) const {
  const VoxelCube* cube = store_.find(cubeOf(voxel));
  if (!cube) return kNaN;
  const int i = indexInCube(voxel);
  return cube->known[i / 64] >> (i % 64) & 1 ? cube->log_odds[i] : kNaN;
}

void VoxelMap::set(const VoxelKey& voxel, float log_odds) {
  VoxelCube& cube = store_.cube(cubeOf(voxel));
  const int i = indexInCube(voxel);
  cube.log_odds[i] = log_odds;
  cube.known[i / 64] |= std::uint64_t{1} << (i % 64);
}

std::size_t VoxelMap::keepAbout(double x, double y) {
  if (params_.window == 0.0) return 0;
  const double side = kCubeSide * params_.resolution, most = 0.5 * params_.window + 0.5 * side;
  return store_.drop([&](const CubeKey& place) {
    return std::abs((place.x() + 0.5) * side - x) > most || std::abs((place.y() + 0.5) * side - y) > most;
  });
}

}  // namespace field_fusion::core
