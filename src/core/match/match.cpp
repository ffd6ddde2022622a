#include "field_fusion/core/match/match.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

/// How much better one verdict on a body is than that of another camera.
bool better(const Verdict& a, const Verdict& b) {
  const auto key = [](const Verdict& v) {
    const double distance = std::isnan(v.distance) ? std::numeric_limits<double>::infinity() : v.distance;
    return std::make_tuple(v.partner < 0, v.reason != MatchReason::kTaken, distance);
  };
  return key(a) < key(b);
}

/// Squared Mahalanobis distance of their places; NaN where a place or its covariance is not known.
double distance2(const Obstacle& a, const Obstacle& b) {
  const Eigen::Vector3d difference = a.position - b.position;
  const Eigen::Matrix3d covariance = a.covariance + b.covariance;
  if (!difference.allFinite() || !covariance.allFinite()) return kNaN;
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace

void Matcher::setParams(const MatchParams& params) {
  params_ = params;
  const double bearing_sigma = radians(params.obstacle.bearing_sigma);
  Gate gate;
  gate.setParams(params.gate, params.obstacle.lidar_range_sigma, bearing_sigma);
  optimal_.setGate(gate);
  margin_ = 2.0 * bearing_sigma;
  joiner_.setParams(params.shape, gate, margin_);
  splitter_.setParams(params.split, gate, margin_);
  outline_.setParams(params.shape, params.obstacle.lidar_range_sigma);
  tolerance_.setParams(params.tolerance);
}

const std::vector<Obstacle>& Matcher::run(const std::vector<Cluster>& clusters,
                                          const std::vector<Point>& points,
                                          const std::vector<std::optional<CameraView>>& views) {
  bodies_.clear();
  for (std::size_t c = 0; c < clusters.size(); ++c)
    if (!clusters[c].faint) bodies_.push_back({clusters[c], static_cast<int>(c), 0, {}});
  if (params_.method == MatchMethod::kOptimal)
    for (const auto& view : views) {
      if (!view) continue;
      joiner_.run(bodies_, points, *view);
      splitter_.run(bodies_, points, *view);
    }

  verdicts_.clear();
  for (const auto& view : views) verdicts_.push_back(view ? judge(*view) : Verdicts{});
  if (params_.method == MatchMethod::kOptimal)
    for (std::size_t camera = 0; camera < views.size(); ++camera)
      if (views[camera]) claimFaint(clusters, *views[camera], verdicts_[camera]);
  obstacles_.clear();
  addBodies(points, views);
  for (std::size_t camera = 0; camera < views.size(); ++camera)
    if (views[camera]) addCameraOnly(static_cast<int>(camera), *views[camera], verdicts_[camera].camera);
  return obstacles_;
}

const Verdicts& Matcher::judge(const CameraView& view) {
  if (params_.method == MatchMethod::kOptimal) return optimal_.run(bodies_, view);
  lidar_.clear();
  for (const LidarTarget& body : bodies_) lidar_.push_back(body.cluster.polar);
  camera_.clear();
  for (const CameraTarget& target : view.targets) camera_.push_back(target.polar);
  return tolerance_.run(lidar_, camera_);
}

/// What a camera claims joins the bodies; to the other cameras it is a body without partner.
void Matcher::claimFaint(const std::vector<Cluster>& clusters, const CameraView& view, Verdicts& verdicts) {
  const auto claimed = [&](std::size_t place) {
    return std::any_of(bodies_.rbegin(), bodies_.rend(),
                       [&](const LidarTarget& b) { return b.place == static_cast<int>(place); });
  };
  faint_.clear();
  for (std::size_t c = 0; c < clusters.size(); ++c)
    if (clusters[c].faint && !claimed(c)) faint_.push_back({clusters[c], static_cast<int>(c), 0, {}});
  unmatched_.targets.clear();
  unmatched_.T_view_lidar = view.T_view_lidar;
  unmatched_place_.clear();
  for (std::size_t t = 0; t < view.targets.size(); ++t) {
    const CameraTarget& target = view.targets[t];
    if (verdicts.camera[t].partner >= 0 || !target.box.known() || !std::isfinite(target.ray_range)) continue;
    unmatched_.targets.push_back(target);
    unmatched_place_.push_back(static_cast<int>(t));
  }
  if (faint_.empty() || unmatched_.targets.empty()) return;

  const Verdicts& found = optimal_.run(faint_, unmatched_);
  for (std::size_t f = 0; f < faint_.size(); ++f) {
    const int partner = found.lidar[f].partner;
    if (partner < 0) continue;
    const Eigen::Vector3d centre = view.T_view_lidar * faint_[f].cluster.centre.cast<double>();
    if (!unmatched_.targets[partner].box.contains(centre, margin_)) continue;
    const int target = unmatched_place_[partner];
    verdicts.camera[target] = found.lidar[f];
    verdicts.camera[target].partner = static_cast<int>(bodies_.size());
    bodies_.push_back(faint_[f]);
    for (Verdicts& camera : verdicts_) camera.lidar.emplace_back();
    verdicts.lidar.back() = found.lidar[f];
    verdicts.lidar.back().partner = target;
  }
}

void Matcher::addBodies(const std::vector<Point>& points,
                        const std::vector<std::optional<CameraView>>& views) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Verdict best;
    best.reason = MatchReason::kNoPartnerMessage;
    int by = -1;
    for (std::size_t camera = 0; camera < views.size(); ++camera) {
      if (!views[camera] || (by >= 0 && !better(verdicts_[camera].lidar[b], best))) continue;
      by = static_cast<int>(camera);
      best = verdicts_[camera].lidar[b];
    }
    const CameraView* view = best.partner < 0 ? nullptr : &*views[by];
    const CameraTarget* target = view ? &view->targets[best.partner] : nullptr;
    obstacles_.push_back(target ? matchedObstacle(bodies_[b], by, *target, best, params_.obstacle)
                                : lidarObstacle(bodies_[b], best, params_.obstacle));
    seen_points_.clear();
    forEachPoint(bodies_[b], [&](std::uint32_t i) { seen_points_.push_back(points[i]); });
    if (target && params_.method == MatchMethod::kOptimal)
      if (const auto outline = outline_.run(seen_points_, *target, view->T_view_lidar)) {
        complete(obstacles_.back(), *outline);
        continue;
      }
    if (!seen_points_.empty()) obstacles_.back().face = nearestOf(seen_points_);
  }
}

void Matcher::addCameraOnly(int camera, const CameraView& view, const std::vector<Verdict>& verdicts) {
  seen_.clear();
  for (std::size_t t = 0; t < view.targets.size(); ++t)
    if (verdicts[t].partner < 0)
      seen_.push_back(cameraObstacle(camera, view.targets[t], verdicts[t], params_.obstacle));

  const double limit = chiSquareQuantile(params_.gate.gate_probability, 3);
  const std::size_t first = bodies_.size(), known = obstacles_.size() - first;
  candidates_.clear();
  for (std::size_t s = 0; s < seen_.size(); ++s)
    for (std::size_t k = 0; k < known; ++k)
      if (const double distance = distance2(seen_[s], obstacles_[first + k]); distance <= limit)
        candidates_.push_back({static_cast<int>(s), static_cast<int>(k), distance});
  const auto& same =
      same_body_.run(static_cast<int>(seen_.size()), static_cast<int>(known), candidates_, limit);
  for (std::size_t s = 0; s < seen_.size(); ++s) {
    if (same[s] < 0)
      obstacles_.push_back(seen_[s]);
    else if (Obstacle& other = obstacles_[first + same[s]];
             seen_[s].covariance.determinant() < other.covariance.determinant())
      other = seen_[s];
  }
}

}  // namespace field_fusion::core
