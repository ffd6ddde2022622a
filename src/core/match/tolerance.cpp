#include "field_fusion/core/match/tolerance.h"

#include <algorithm>
#include <tuple>

namespace field_fusion::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }

/// NaN has no place in an order.
double sortable(double range) { return std::isnan(range) ? kInfinity : range; }

}  // namespace

const Verdicts& ToleranceMatcher::run(const std::vector<Polar>& lidar, const std::vector<Polar>& camera) {
  rankPairs(lidar, camera);
  result_.lidar.clear();
  for (const Pair& best : best_of_lidar_) {
    const bool none = best.rank == Rank::kNothing && !camera.empty();
    result_.lidar.push_back(verdict(best, none ? MatchReason::kNoBearing : reasonAgainst(best), -1));
  }
  result_.camera.clear();
  for (std::size_t c = 0; c < camera.size(); ++c) {
    auto reason = reasonAgainst(best_of_camera_[c]);
    if (!std::isfinite(camera[c].range)) reason = MatchReason::kRangeUnknown;
    if (!std::isfinite(camera[c].azimuth)) reason = MatchReason::kNoBearing;
    result_.camera.push_back(verdict(best_of_camera_[c], reason, -1));
  }
  for (const Pair& pair : within_) {
    Verdict &l = result_.lidar[pair.lidar], &c = result_.camera[pair.camera];
    if (l.partner >= 0 || c.partner >= 0) continue;
    l = verdict(pair, MatchReason::kMatched, pair.camera);
    c = verdict(pair, MatchReason::kMatched, pair.lidar);
  }
  return result_;
}

void ToleranceMatcher::rankPairs(const std::vector<Polar>& lidar, const std::vector<Polar>& camera) {
  const auto key = [&](const Pair& p) {
    const Polar &l = lidar[p.lidar], &c = camera[p.camera];
    return std::make_tuple(p.rank, p.range_term + p.azimuth_term, sortable(l.range), l.azimuth,
                           sortable(c.range), c.azimuth, p.lidar, p.camera);
  };
  const auto before = [&](const Pair& a, const Pair& b) { return key(a) < key(b); };
  within_.clear();
  best_of_lidar_.assign(lidar.size(), {});
  best_of_camera_.assign(camera.size(), {});
  for (std::size_t l = 0; l < lidar.size(); ++l)
    for (std::size_t c = 0; c < camera.size(); ++c) {
      Pair pair = compare(lidar[l], camera[c]);
      if (pair.rank == Rank::kNothing) continue;
      pair.lidar = static_cast<int>(l);
      pair.camera = static_cast<int>(c);
      if (pair.rank == Rank::kWithin) within_.push_back(pair);
      for (Pair* best : {&best_of_lidar_[l], &best_of_camera_[c]})
        if (best->rank == Rank::kNothing || before(pair, *best)) *best = pair;
    }
  std::sort(within_.begin(), within_.end(), before);
}

ToleranceMatcher::Pair ToleranceMatcher::compare(const Polar& lidar, const Polar& camera) const {
  const double angle_tolerance = radians(params_.angle_tolerance);
  Pair pair;
  pair.azimuth_difference = angleDifference(lidar.azimuth, camera.azimuth);
  if (std::isnan(pair.azimuth_difference)) return pair;
  pair.rank = Rank::kNoRange;
  pair.azimuth_term = square(pair.azimuth_difference / angle_tolerance);
  const double range_difference = lidar.range - camera.range;
  if (!std::isfinite(range_difference)) return pair;
  pair.range_difference = range_difference;
  pair.range_term = square(range_difference / params_.dist_tolerance);
  const bool within = std::abs(range_difference) <= params_.dist_tolerance &&
                      std::abs(pair.azimuth_difference) <= angle_tolerance;
  pair.rank = within ? Rank::kWithin : Rank::kOutside;
  return pair;
}

MatchReason ToleranceMatcher::reasonAgainst(const Pair& best) {
  switch (best.rank) {
    case Rank::kWithin:
      return MatchReason::kTaken;
    case Rank::kOutside:
      return best.range_term > best.azimuth_term ? MatchReason::kRangeDiffers : MatchReason::kAzimuthDiffers;
    case Rank::kNoRange:
      return best.azimuth_term > 1.0 ? MatchReason::kAzimuthDiffers : MatchReason::kRangeUnknown;
    case Rank::kNothing:
      break;
  }
  return MatchReason::kNoCandidate;
}

Verdict ToleranceMatcher::verdict(const Pair& pair, MatchReason reason, int partner) {
  const bool compared = pair.rank == Rank::kWithin || pair.rank == Rank::kOutside;
  const double distance = compared ? std::sqrt(pair.range_term + pair.azimuth_term) : double(kNaN);
  return {partner, reason, pair.range_difference, pair.azimuth_difference, distance};
}

}  // namespace field_fusion::core
