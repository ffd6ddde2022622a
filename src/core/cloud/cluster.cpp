#include "field_fusion/core/cloud/cluster.h"

#include <algorithm>
#include <tuple>

namespace field_fusion::core {

const Clusters& Clusterer::run(const Cloud& cloud) {
  const std::vector<int>& sets = dbscan_.run(cloud, static_cast<float>(params_.epsilon), params_.min_points);
  result_.unusable = cloud.size() - dbscan_.usableCount();
  measure(cloud, sets, dbscan_.clusterCount());
  order();
  fill(cloud, sets);
  describe();
  return result_;
}

void Clusterer::measure(const Cloud& cloud, const std::vector<int>& sets, int set_count) {
  extents_.assign(set_count, {});
  std::size_t members = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (sets[i] == kNoise) continue;
    Extent& extent = extents_[sets[i]];
    const float range2 = cloud[i].position().squaredNorm();
    if (extent.count == 0) extent = {0, i, range2};
    ++extent.count;
    extent.nearest2 = std::min(extent.nearest2, range2);
    ++members;
  }
  result_.noise = dbscan_.usableCount() - members;
}

void Clusterer::order() {
  kept_.clear();
  for (std::size_t set = 0; set < extents_.size(); ++set)
    if (extents_[set].count <= static_cast<std::uint32_t>(params_.max_points))
      kept_.push_back(static_cast<int>(set));
  result_.too_large = extents_.size() - kept_.size();
  std::sort(kept_.begin(), kept_.end(), [this](int a, int b) {
    return std::tie(extents_[a].nearest2, extents_[a].first) <
           std::tie(extents_[b].nearest2, extents_[b].first);
  });
}

void Clusterer::fill(const Cloud& cloud, const std::vector<int>& sets) {
  place_.assign(extents_.size(), kNoise);
  result_.clusters.resize(kept_.size());
  std::uint32_t first = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Extent& extent = extents_[kept_[k]];
    place_[kept_[k]] = static_cast<int>(k);
    result_.clusters[k] = {};
    result_.clusters[k].points = {first, 0};
    result_.clusters[k].nearest_range = std::sqrt(extent.nearest2);
    first += extent.count;
  }
  result_.points.resize(first);
  result_.labels.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const int label = sets[i] == kNoise ? kNoise : place_[sets[i]];
    result_.labels[i] = label;
    if (label == kNoise) continue;
    IndexRange& range = result_.clusters[label].points;
    result_.points[range.first + range.count++] = cloud[i];
  }
}

void Clusterer::describe() {
  for (Cluster& cluster : result_.clusters) {
    const Point* points = result_.points.data() + cluster.points.first;
    for (std::uint32_t i = 0; i < cluster.points.count; ++i) cluster.box.extend(points[i].position());
    cluster.centre = (cluster.box.min() + cluster.box.max()) / 2.f;
    cluster.polar = polar(cluster.centre.cast<double>());
  }
}

}  // namespace field_fusion::core
