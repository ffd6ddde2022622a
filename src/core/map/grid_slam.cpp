#include "field_fusion/core/map/grid_slam.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <stdexcept>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/counter_random.h"
#include "field_fusion/core/map/particle_weights.h"

namespace field_fusion::core {
namespace {

Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double yaw) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << std::cos(yaw), -std::sin(yaw), std::sin(yaw), std::cos(yaw);
  return R * covariance * R.transpose();
}

Pose2 drawn(const Pose2& mean, const Eigen::Matrix3d& covariance, CounterRandom& random) {
  const Eigen::Matrix3d spread = covariance.llt().matrixL();
  Eigen::Vector3d z;
  for (int a = 0; a < 3; ++a) z[a] = random.normal();
  const Eigen::Vector3d d = spread * z;
  return {mean.x + d.x(), mean.y + d.y(), angleDifference(mean.yaw + d.z(), 0.0)};
}

MatchSettings settingsOf(const GridSlamParams& p) {
  return {p.resolution, p.sigma, p.outlier, p.effective_beams};
}

}  // namespace

GridSlam::GridSlam(const GridSlamParams& params) : params_(checked(params)), workers_(params.threads) {
  matchers_.assign(workers_.number(), ScanMatcher(settingsOf(params_)));
  insertions_.resize(workers_.number());
  reset();
}

void GridSlam::reset() {
  Particle fresh;
  fresh.map = TileMap(static_cast<float>(params_.occupied));
  particles_.assign(static_cast<std::size_t>(params_.particles), fresh);
  weights_.assign(particles_.size(), 1.0 / params_.particles);
  best_ = 0, count_ = 0, effective_ = params_.particles, since_ = {}, start_.reset();
}

void GridSlam::reset(const TileMap& map, const PosePrior& start) {
  reset();
  for (Particle& p : particles_) p.map = map, p.pose = start.mean;
  start_ = start;
}

void GridSlam::setLive(const GridSlamParams& params) {
  params_ = checked(params);
}

GridSlam::Outcome GridSlam::process(const SlamScan& scan, const Pose2& T_odom_base, std::int64_t stamp_ns) {
  if (!T_odom_base.finite()) throw std::invalid_argument("the odometry's pose is not finite");
  if (count_ == 0) {
    if (scan.hits.empty()) return Outcome::kBlind;
    begin(T_odom_base, stamp_ns);
    if (!start_) {
      record(scan, stamp_ns);
      return Outcome::kProcessed;
    }
  } else {
    follow(T_odom_base, stamp_ns);
    if (!due(stamp_ns)) return Outcome::kSkipped;
  }
  const bool blind = scan.hits.empty();
  workers_.share(particles_.size(), [&](std::size_t i, int worker) {
    move(particles_[i], i, scan, matchers_[static_cast<std::size_t>(worker)]);
  });
  if (!blind) weigh();
  record(scan, stamp_ns);
  return blind ? Outcome::kBlind : Outcome::kProcessed;
}

void GridSlam::begin(const Pose2& T_odom_base, std::int64_t stamp_ns) {
  last_odom_ = T_odom_base, odom_ns_ = stamp_ns, since_ = {};
  if (!start_)
    for (Particle& p : particles_) p.pose = T_odom_base;
}

/// A driver that starts anew makes steps that no robot makes in that time; after a gap between scans a long one may be true.
void GridSlam::follow(const Pose2& T_odom_base, std::int64_t stamp_ns) {
  constexpr double kSlack = 0.75, kSlackTurn = radians(60.0);  // m, rad: recorded stamps jitter, half a second and more
  const Pose2 step = between(last_odom_, T_odom_base);
  const double seconds = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, stamp_ns - odom_ns_));
  last_odom_ = T_odom_base, odom_ns_ = stamp_ns;
  const double way = step.position().norm();
  if (way > params_.max_speed * seconds + kSlack ||
      std::abs(step.yaw) > radians(params_.max_turn_rate) * seconds + kSlackTurn) {
    ++jumps_;
    return;
  }
  since_.step = since_.step * step;
  since_.way += way, since_.turn += std::abs(step.yaw);
}

bool GridSlam::due(std::int64_t stamp_ns) const {
  const double age = 1e-9 * static_cast<double>(stamp_ns - last_ns_);
  return since_.way >= params_.linear_update || since_.turn >= radians(params_.angular_update) ||
         (params_.temporal_update >= 0.0 && age > params_.temporal_update);
}

PosePrior GridSlam::prior(const Particle& p) const {
  if (start_) return *start_;
  return {p.pose * since_.step, turned(covariance(since_, params_.motion), p.pose.yaw)};
}

void GridSlam::move(Particle& p, std::size_t index, const SlamScan& scan, ScanMatcher& matcher) const {
  CounterRandom random(mixed(static_cast<std::uint64_t>(params_.seed) + 1), count_ * particles_.size() + index);
  const PosePrior prior = this->prior(p);
  if (scan.hits.empty()) {
    p.pose = drawn(prior.mean, prior.covariance, random);
    return;
  }
  const Match match = matcher.match(scan, p.map, prior);
  double evidence = match.log_evidence, score = match.score;
  if (match.score >= params_.min_score) {
    p.pose = drawn(match.mean, match.covariance, random);
  } else {
    p.pose = drawn(prior.mean, prior.covariance, random);
    evidence = matcher.logLikelihood(scan, p.map, p.pose, &score);
  }
  p.fit = score / static_cast<double>(scan.hits.size());
  p.log_weight += evidence / params_.smoothing, p.log_total += evidence / params_.smoothing;
}

void GridSlam::weigh() {
  std::vector<double> logs;
  for (const Particle& p : particles_) logs.push_back(p.log_weight);
  weights_ = normalised(logs);
  effective_ = effectiveNumber(weights_);
  if (effective_ < params_.resample_threshold * static_cast<double>(particles_.size())) resample();
  const auto less = [](const Particle& a, const Particle& b) { return a.log_total < b.log_total; };
  best_ = static_cast<std::size_t>(std::max_element(particles_.begin(), particles_.end(), less) - particles_.begin());
}

void GridSlam::resample() {
  CounterRandom random(mixed(static_cast<std::uint64_t>(params_.seed) + 2), count_);
  std::vector<Particle> next;
  next.reserve(particles_.size());
  for (const std::size_t from : resampled(weights_, random.uniform())) next.push_back(particles_[from]);
  particles_ = std::move(next);
  for (Particle& p : particles_) p.log_weight = 0.0;
  weights_.assign(particles_.size(), 1.0 / static_cast<double>(particles_.size()));
}

/// Ends one turn of the filter: paths and maps go on from the poses as they are now.
void GridSlam::record(const SlamScan& scan, std::int64_t stamp_ns) {
  workers_.share(particles_.size(), [&](std::size_t i, int worker) {
    Particle& p = particles_[i];
    p.path = new PathNode({stamp_ns, p.pose}, std::move(p.path));
    insertions_[static_cast<std::size_t>(worker)].insert(scan, p.pose, params_.resolution,
                                                         count_ * particles_.size() + i + 1, p.map);
  });
  ++count_, last_ns_ = stamp_ns, since_ = {}, start_.reset();
  if (count_ % static_cast<std::uint64_t>(std::max(1, params_.path_length / 2)) == 0)  // seldom: it walks along the path
    for (Particle& p : particles_) cutPath(p.path.get(), params_.path_length);
}

}  // namespace field_fusion::core
