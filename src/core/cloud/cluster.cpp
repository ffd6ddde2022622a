#include "field_fusion/core/cloud/cluster.h"

#include <algorithm>
#include <tuple>

namespace field_fusion::core {
namespace {

// Points that tell the farthest things from stray returns with the method `adaptive`.
constexpr int kFewest = 4;

}  // namespace

void describe(Cluster& cluster, const Point* points, std::size_t count, OrientedBoxFitter* fitter) {
  for (std::size_t i = 0; i < count; ++i) cluster.box.extend(points[i].position());
  cluster.centre = (cluster.box.min() + cluster.box.max()) / 2.f;
  cluster.polar = polar(cluster.centre.cast<double>());
  if (fitter) cluster.oriented_box = fitter->fit(points, count);
}

const Clusters& Clusterer::run(const Cloud& cloud) {
  result_.row_gap = kNaN;
  const Sets sets = separate(cloud);
  result_.unusable = cloud.size() - sets.usable;
  measure(cloud, sets);
  order();
  fill(cloud, sets.labels);
  describeAll();
  return result_;
}

Clusterer::Sets Clusterer::separate(const Cloud& cloud) {
  const auto epsilon = static_cast<float>(params_.epsilon);
  const double theta = radians(params_.theta);
  const auto sets = [](const auto& method, const std::vector<int>& labels) {
    return Sets{labels, method.clusterCount(), method.usableCount()};
  };
  switch (params_.method) {
    case ClusterMethod::kDbscanBeta: {
      const auto& labels = dbscan_beta_.run(cloud, epsilon, params_.min_points, theta);
      return sets(dbscan_beta_, labels);
    }
    case ClusterMethod::kRangeImage: {
      const auto& labels = range_image_.run(cloud, params_.epsilon, theta);
      return sets(range_image_, labels);
    }
    case ClusterMethod::kEuclidean: {
      const auto& labels = dbscan_.runEuclidean(cloud, epsilon);
      return sets(dbscan_, labels);
    }
    case ClusterMethod::kAdaptive:
      return separateAdaptively(cloud);
    case ClusterMethod::kDbscan:
      break;
  }
  const auto& labels = dbscan_.run(cloud, epsilon, params_.min_points);
  return sets(dbscan_, labels);
}

Clusterer::Sets Clusterer::separateAdaptively(const Cloud& cloud) {
  const double gap = params_.row_gap > 0.0 ? radians(params_.row_gap) : row_spacing_.measure(cloud);
  result_.row_gap = gap;
  RowSpacing::close(cloud, gap, params_.epsilon, closed_);
  const auto epsilon = static_cast<float>(params_.epsilon);
  const auto& labels = dbscan_.run(closed_, epsilon, std::min(params_.min_points, kFewest));
  const std::size_t usable = dbscan_.usableCount();
  if (params_.see_through == 0.0) return {labels, dbscan_.clusterCount(), usable};
  const auto& joined =
      seen_through_.run(cloud, labels, dbscan_.clusterCount(), params_.epsilon, params_.see_through);
  return {joined, seen_through_.clusterCount(), usable};
}

/// Points that make a cluster, by the squared range [m^2] of the nearest. DBSCAN knows small clusters from
/// noise by itself. A body's returns thin out as 1 / range^2.
double Clusterer::fewest(float nearest2) const {
  switch (params_.method) {
    case ClusterMethod::kDbscan:
    case ClusterMethod::kDbscanBeta:
      return 1.0;
    case ClusterMethod::kAdaptive: {
      const double full2 = params_.full_range * params_.full_range;
      const double thinned = params_.min_points * std::min(1.0, full2 / std::max(double{nearest2}, 1e-6));
      return std::max(thinned, static_cast<double>(std::min(kFewest, params_.min_points)));
    }
    default:
      return params_.min_points;
  }
}

void Clusterer::measure(const Cloud& cloud, const Sets& sets) {
  extents_.assign(sets.count, {});
  std::size_t members = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (sets.labels[i] == kNoise) continue;
    Extent& extent = extents_[sets.labels[i]];
    const float range2 = cloud[i].position().squaredNorm();
    if (extent.count == 0) extent = {0, i, range2};
    ++extent.count;
    extent.nearest2 = std::min(extent.nearest2, range2);
    ++members;
  }
  result_.noise = sets.usable - members;
}

void Clusterer::order() {
  const auto most = static_cast<std::uint32_t>(params_.max_points);
  kept_.clear();
  result_.too_large = 0;
  for (std::size_t set = 0; set < extents_.size(); ++set) {
    const std::uint32_t count = extents_[set].count;
    if (count < fewest(extents_[set].nearest2))
      result_.noise += count;
    else if (count > most)
      ++result_.too_large;
    else
      kept_.push_back(static_cast<int>(set));
  }
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

void Clusterer::describeAll() {
  for (Cluster& cluster : result_.clusters)
    describe(cluster, result_.points.data() + cluster.points.first, cluster.points.count,
             params_.oriented_boxes ? &box_fitter_ : nullptr);
}

}  // namespace field_fusion::core
