#include "field_fusion/core/cloud/cluster.h"

#include <algorithm>
#include <numeric>
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
  result_.noise = sets.usable - measure(cloud, sets);
  choose();
  label(cloud, sets.labels);
  result_.clusters.clear();
  result_.points.clear();
  append(cloud, sets.labels, false);
  result_.faint = 0;
  if (params_.faint) addFaint(cloud, sets.labels);
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

/// Counts the points that are in sets.
std::size_t Clusterer::measure(const Cloud& cloud, const Sets& sets) {
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
  return members;
}

void Clusterer::choose() {
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
  sortByRange();
}

void Clusterer::sortByRange() {
  std::sort(kept_.begin(), kept_.end(), [this](int a, int b) {
    return std::tie(extents_[a].nearest2, extents_[a].first) <
           std::tie(extents_[b].nearest2, extents_[b].first);
  });
  place_.assign(extents_.size(), kNoise);
  for (std::size_t k = 0; k < kept_.size(); ++k) place_[kept_[k]] = static_cast<int>(k);
}

void Clusterer::label(const Cloud& cloud, const std::vector<int>& sets) {
  result_.labels.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    result_.labels[i] = sets[i] == kNoise ? kNoise : place_[sets[i]];
}

void Clusterer::append(const Cloud& cloud, const std::vector<int>& sets, bool faint) {
  const std::size_t before = result_.clusters.size();
  auto first = static_cast<std::uint32_t>(result_.points.size());
  for (const int set : kept_) {
    Cluster& cluster = result_.clusters.emplace_back();
    cluster.points = {first, 0};
    cluster.nearest_range = std::sqrt(extents_[set].nearest2);
    cluster.faint = faint;
    first += extents_[set].count;
  }
  result_.points.resize(first);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (sets[i] == kNoise || place_[sets[i]] == kNoise) continue;
    IndexRange& range = result_.clusters[before + static_cast<std::size_t>(place_[sets[i]])].points;
    result_.points[range.first + range.count++] = cloud[i];
  }
}

/// What belongs to no cluster is grouped by nearness alone. Clusters that were too large are not faint.
void Clusterer::addFaint(const Cloud& cloud, const std::vector<int>& sets) {
  const auto most = static_cast<std::uint32_t>(params_.max_points);
  rest_.clear();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (result_.labels[i] == kNoise && (sets[i] == kNoise || extents_[sets[i]].count <= most))
      rest_.push_back(cloud[i]);
  const auto& groups = dbscan_.runEuclidean(rest_, static_cast<float>(params_.epsilon));
  measure(rest_, {groups, dbscan_.clusterCount(), dbscan_.usableCount()});
  kept_.resize(extents_.size());
  std::iota(kept_.begin(), kept_.end(), 0);
  sortByRange();
  append(rest_, groups, true);
  result_.faint = kept_.size();
}

void Clusterer::describeAll() {
  for (Cluster& cluster : result_.clusters)
    describe(cluster, result_.points.data() + cluster.points.first, cluster.points.count,
             params_.oriented_boxes ? &box_fitter_ : nullptr);
}

}  // namespace field_fusion::core
