#include "field_fusion/core/sim/beam_caster.h"

#include <algorithm>
#include <array>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {
namespace {

constexpr std::size_t kBatch = 256;   // rays that are cast at once: their hits stay in the nearest cache
constexpr std::size_t kShare = 1024;  // beams that one worker takes
constexpr std::uint64_t kRimNoise = 1ull << 40, kAngleNoise = 1ull << 41;  // sequences of a beam's own

/// Two ranges of one surface differ by less [m].
float surfaceStep(float range) { return 0.03f + 0.002f * range; }

double lastOf(const std::vector<float>& times) {
  return times.empty() ? 0.0 : *std::max_element(times.begin(), times.end());
}

}  // namespace

BeamCaster::BeamCaster(const LidarParams& params, BeamGrid grid, std::uint64_t seed)
    : params_(checked(params)),
      grid_(std::move(grid)),
      noise_(params, grid_.rows, seed),
      seed_(seed),
      duration_(lastOf(grid_.times)),
      workers_(params.threads),
      waiting_(static_cast<std::size_t>(workers_.number())),
      middles_(grid_.size()),
      hits_(grid_.size()),
      returns_(grid_.size()) {}

const std::vector<BeamReturn>& BeamCaster::run(Caster& caster, const PoseAt& T_world_sensor, double start) {
  const PoseTrack track(T_world_sensor, start, start + duration_);
  caster.setWindow(start, start + duration_);
  const Scan scan{caster, track, seedOf(seed_, start)};
  const std::size_t shares = (grid_.size() + kShare - 1) / kShare;
  const auto end = [&](std::size_t share) { return std::min(grid_.size(), (share + 1) * kShare); };
  workers_.share(shares, [&](std::size_t share, int) { castMiddles(scan, share * kShare, end(share)); });
  workers_.share(shares, [&](std::size_t share, int worker) {
    castRims(scan, share * kShare, end(share), waiting_[static_cast<std::size_t>(worker)]);
  });
  return returns_;
}

/// The mirror is a little off where the encoder says it is: about the sensor's z, so small that a unit vector
/// stays one.
Ray BeamCaster::middleRay(const Scan& scan, std::size_t beam) const {
  Eigen::Vector3f direction = grid_.directions[beam];
  if (params_.angle_noise > 0.0) {
    BeamRandom random(scan.seed + kAngleNoise, beam);
    const float turn = static_cast<float>(radians(params_.angle_noise)) * random.normal();
    direction += turn * Eigen::Vector3f(-direction.y(), direction.x(), 0.f);
    direction.normalize();
  }
  const PoseTrack::Pose pose = scan.track.at(grid_.times[beam]);
  const float time = duration_ > 0.0 ? grid_.times[beam] / static_cast<float>(duration_) : 0.f;
  return {pose.position, pose.rotation * direction, time};
}

void BeamCaster::castMiddles(const Scan& scan, std::size_t first, std::size_t last) {
  for (std::size_t beam = first; beam < last; beam += kBatch) {
    const std::size_t count = std::min(kBatch, last - beam);
    for (std::size_t i = beam; i < beam + count; ++i) middles_[i] = middleRay(scan, i);
    scan.caster.cast(&middles_[beam], &hits_[beam], count);
  }
}

/// Whether `hit`, along `direction`, lies where the surface that a beam met goes on as a plane.
bool BeamCaster::sameSurface(std::size_t beam, const Eigen::Vector3f& direction, const Hit& hit) const {
  const Hit& mine = hits_[beam];
  if (hit.body != mine.body) return false;
  if (mine.body == Hit::kNothing) return true;
  const float expected = mine.range * mine.normal.dot(middles_[beam].direction) / mine.normal.dot(direction);
  return std::abs(expected - hit.range) < surfaceStep(mine.range);
}

/// Looks as far to the sides as the spot reaches, and to the rows above and below.
bool BeamCaster::atEdge(std::size_t beam) const {
  const Hit& mine = hits_[beam];
  if (mine.material && mine.material->transparency > 0.f) return true;
  const int column = static_cast<int>(beam) % grid_.columns, row = static_cast<int>(beam) / grid_.columns;
  const float range = std::isfinite(mine.range) ? mine.range : static_cast<float>(params_.max_range);
  const float radius = 0.5f * spotSize(params_, range).x();
  constexpr int kFarthest = 4;
  const int reach =
      std::clamp(static_cast<int>(std::ceil(radius / (range * grid_.step + 1e-6f))), 1, kFarthest);
  const auto differs = [&](std::size_t other) {
    return !sameSurface(beam, middles_[other].direction, hits_[other]);
  };
  for (int d = 1; d <= reach; ++d) {
    if (column >= d && differs(beam - d)) return true;
    if (column + d < grid_.columns && differs(beam + d)) return true;
  }
  return (row > 0 && differs(beam - grid_.columns)) ||
         (row + 1 < grid_.rows && differs(beam + grid_.columns));
}

/// The spot is an ellipse of even light, cut into a middle and eight sectors of equal area; one ray for each,
/// at a place drawn within it. All leave from the exit window and spread from there.
void BeamCaster::addRims(const Scan& scan, std::size_t beam, std::vector<Ray>& rays) const {
  BeamRandom random(scan.seed + kRimNoise, beam);
  const Ray& middle = middles_[beam];
  const Eigen::Quaternionf rotation = scan.track.at(grid_.times[beam]).rotation;
  const Eigen::Vector3f side = (rotation * Eigen::Vector3f::UnitZ()).cross(middle.direction).normalized();
  const Eigen::Vector3f up = middle.direction.cross(side);
  const Eigen::Vector2f exit = 0.5f * spotSize(params_, 0.f), growth = 0.5f * spotSize(params_, 1.f) - exit;
  for (int i = 0; i < kRims; ++i) {
    const float radius = std::sqrt((1.f + kRims * random.uniform()) / (1.f + kRims));
    const float angle = 6.2831853f * (static_cast<float>(i) + random.uniform()) / kRims;
    const float x = radius * std::cos(angle), y = radius * std::sin(angle);
    const Eigen::Vector3f offset = x * exit.x() * side + y * exit.y() * up;
    const Eigen::Vector3f spread = x * growth.x() * side + y * growth.y() * up;
    rays.push_back({middle.origin + offset, (middle.direction + spread).normalized(), middle.time});
  }
}

void BeamCaster::castRims(const Scan& scan, std::size_t first, std::size_t last, Waiting& waiting) {
  for (std::size_t beam = first; beam < last; ++beam) {
    const bool sampled = params_.spot_sampling == SpotSampling::kAlways ||
                         (params_.spot_sampling == SpotSampling::kEdges && atEdge(beam));
    if (!sampled) {
      returns_[beam] = measure(scan, beam, nullptr, nullptr);
      continue;
    }
    addRims(scan, beam, waiting.rays);
    waiting.beams.push_back(beam);
    if (waiting.rays.size() >= kBatch) flush(scan, waiting);
  }
  flush(scan, waiting);
}

void BeamCaster::flush(const Scan& scan, Waiting& w) {
  w.hits.resize(w.rays.size());
  scan.caster.cast(w.rays.data(), w.hits.data(), w.rays.size());
  for (std::size_t k = 0; k < w.beams.size(); ++k)
    returns_[w.beams[k]] = measure(scan, w.beams[k], &w.rays[k * kRims], &w.hits[k * kRims]);
  w.rays.clear(), w.beams.clear();
}

/// Rays of the rim that meet the middle's surface count as the middle: a plane has one range, not nine.
BeamReturn BeamCaster::measure(const Scan& scan, std::size_t beam, const Ray* rays, const Hit* hits) const {
  const Hit& middle = hits_[beam];
  const Eigen::Vector3f& direction = middles_[beam].direction;
  const int count = hits ? kRims + 1 : 1;
  const float share = 1.f / static_cast<float>(count);
  std::array<Glint, kRims + 1> glints;
  glints[0] = {middle.range, share * echoEnergy(middle, direction), middle.body};
  for (int i = 1; i < count; ++i) {
    const Hit& hit = hits[i - 1];
    const bool same = sameSurface(beam, rays[i - 1].direction, hit);
    glints[i] = same ? glints[0] : Glint{hit.range, share * echoEnergy(hit, rays[i - 1].direction), hit.body};
  }
  const float cosine = std::abs(middle.normal.dot(direction));
  const float slope =
      middle.material && cosine > 0.f ? std::sqrt(std::max(0.f, 1.f - cosine * cosine)) / cosine : 0.f;
  BeamRandom random(scan.seed, beam);
  return noise_.measure(glints.data(), count, slope, static_cast<int>(beam) / grid_.columns, random);
}

}  // namespace field_fusion::core::sim
