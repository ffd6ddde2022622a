#include "field_fusion/core/match/optimal.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace field_fusion::core {
namespace {

/// NaN has no place in an order.
double sortable(double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x; }

auto keyOf(const Polar& p) {
  return std::make_tuple(sortable(p.range), sortable(p.azimuth), sortable(p.elevation));
}

template <class Items, class PolarOf>
void sortedOrder(const Items& items, const PolarOf& polar_of, std::vector<int>& order) {
  order.resize(items.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return keyOf(polar_of(items[a])) < keyOf(polar_of(items[b])); });
}

MatchReason reasonOf(const Likeness& likeness) {
  if (likeness.inside) return MatchReason::kTaken;
  if (std::isnan(likeness.distance2)) return MatchReason::kNoCandidate;
  static constexpr MatchReason kReasons[] = {MatchReason::kRangeDiffers, MatchReason::kAzimuthDiffers,
                                             MatchReason::kElevationDiffers};
  Eigen::Index largest = 0;
  likeness.terms.maxCoeff(&largest);
  return kReasons[largest];
}

}  // namespace

const Verdicts& OptimalMatcher::run(const std::vector<LidarTarget>& bodies, const CameraView& view) {
  sortByPlace(bodies, view.targets);
  compareAll(bodies, view);
  const auto& columns = assignment_.run(static_cast<int>(bodies.size()),
                                        static_cast<int>(view.targets.size()), candidates_, gate_.limit());
  judgeAlone(bodies, view.targets);
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    if (columns[row] < 0) continue;
    const int b = body_order_[row], t = target_order_[columns[row]];
    const auto& target = view.targets[t];
    const Likeness likeness = gate_.compare(sightOf(bodies[b].cluster, view.T_view_lidar), target);
    Verdict &of_body = result_.lidar[b], &of_target = result_.camera[t];
    of_body = of_target = verdict(&bodies[b], &target, likeness);
    of_body.reason = of_target.reason = MatchReason::kMatched;
    of_body.partner = t;
    of_target.partner = b;
  }
  return result_;
}

/// As if none were matched.
void OptimalMatcher::judgeAlone(const std::vector<LidarTarget>& bodies,
                                const std::vector<CameraTarget>& targets) {
  const auto placed = [](const CameraTarget& t) { return std::isfinite(t.seen.azimuth); };
  const bool blind = !targets.empty() && std::none_of(targets.begin(), targets.end(), placed);
  result_.lidar.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& [other, likeness] = best_of_body_[b];
    result_.lidar.push_back(verdict(&bodies[b], other < 0 ? nullptr : &targets[other], likeness));
    if (blind) result_.lidar.back().reason = MatchReason::kNoBearing;
  }
  result_.camera.clear();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto& [other, likeness] = best_of_target_[t];
    result_.camera.push_back(verdict(other < 0 ? nullptr : &bodies[other], &targets[t], likeness));
    if (!placed(targets[t])) result_.camera.back().reason = MatchReason::kNoBearing;
  }
}

void OptimalMatcher::sortByPlace(const std::vector<LidarTarget>& bodies,
                                 const std::vector<CameraTarget>& targets) {
  sortedOrder(
      bodies, [](const LidarTarget& b) { return b.cluster.polar; }, body_order_);
  sortedOrder(
      targets, [](const CameraTarget& t) { return t.seen; }, target_order_);
}

void OptimalMatcher::compareAll(const std::vector<LidarTarget>& bodies, const CameraView& view) {
  candidates_.clear();
  best_of_body_.assign(bodies.size(), {});
  best_of_target_.assign(view.targets.size(), {});
  for (std::size_t row = 0; row < body_order_.size(); ++row) {
    const int b = body_order_[row];
    const Sight sight = sightOf(bodies[b].cluster, view.T_view_lidar);
    for (std::size_t column = 0; column < target_order_.size(); ++column) {
      const int t = target_order_[column];
      const Likeness likeness = gate_.compare(sight, view.targets[t]);
      if (likeness.inside)
        candidates_.push_back({static_cast<int>(row), static_cast<int>(column), likeness.cost});
      keepNearer(best_of_body_[b], t, likeness);
      keepNearer(best_of_target_[t], b, likeness);
    }
  }
}

/// What is within the gate comes before what is not: the limits with and without range differ.
void OptimalMatcher::keepNearer(Best& best, int other, const Likeness& likeness) {
  if (std::isnan(likeness.distance2)) return;
  const auto key = [](const Likeness& l) { return std::make_pair(!l.inside, l.distance2); };
  if (best.other < 0 || key(likeness) < key(best.likeness)) best = {other, likeness};
}

Verdict OptimalMatcher::verdict(const LidarTarget* body, const CameraTarget* target,
                                const Likeness& likeness) {
  Verdict out;
  out.reason = reasonOf(likeness);
  if (!body || !target) return out;
  out.range_difference = body->cluster.polar.range - target->polar.range;
  out.azimuth_difference = angleDifference(body->cluster.polar.azimuth, target->polar.azimuth);
  out.elevation_difference = body->cluster.polar.elevation - target->polar.elevation;
  out.distance = std::sqrt(likeness.distance2);
  return out;
}

}  // namespace field_fusion::core
