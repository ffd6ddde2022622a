#include "field_fusion/core/map/scan_matcher.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

constexpr float kAlongWall = 1.75f;  // [cells] off the nearest cell along its wall that say nothing: walls are ragged
constexpr double kUnseen = 0.25;     // cost of an end where nobody has looked yet, of the full one
constexpr double kMargin = 24.0;     // [cells] that a match may move

/// How an end at (px, py), turned by (c, s) from the robot's frame, misses what is nearest to it: across and
/// along the wall [cells]. The wall's direction is the map's, or else the scan's own. Within a wall nothing is known
/// along it: maps have holes there, and what is nearest is chance.
struct Miss {
  float across, along, nx, ny;
  bool wall = true;

  template <class Hit>
  Miss(const Wall& nearest, int x, int y, float px, float py, const Hit& hit, float c, float s) {
    const float dx = px - FieldWindow::tileCorner(x) - nearest.x, dy = py - FieldWindow::tileCorner(y) - nearest.y;
    const bool line = nearest.line();
    const float own_x = c * hit.nx - s * hit.ny, own_y = s * hit.nx + c * hit.ny;
    const bool own = hit.nx != 0.f || hit.ny != 0.f;
    nx = line ? nearest.nx : own_x, ny = line ? nearest.ny : own_y;
    const bool inside = own && std::abs(nx * own_x + ny * own_y) > 0.9f;  // of a wall, for map and scan alike
    wall = line || own;
    if (!wall) nx = 1.f;
    across = nx * dx + ny * dy, along = nx * dy - ny * dx;
    const float slack = wall ? kAlongWall : 0.f;
    along = inside ? 0.f : std::copysign(std::max(0.f, std::abs(along) - slack), along);
  }
  float squared() const { return across * across + along * along; }
};

}  // namespace

ScanMatcher::ScanMatcher(const MatchSettings& settings)
    : settings_(settings),
      outlier_(static_cast<float>(settings.outlier * settings.sigma / settings.resolution)) {}

void ScanMatcher::open(const SlamScan& scan, TileMap& map, const Pose2& about) {
  const auto scale = static_cast<float>(1.0 / settings_.resolution);
  hits_.clear();
  double sum = 0.0;
  float farthest = 0.f;
  for (const ScanHit& hit : scan.hits) {
    const Eigen::Vector2f end = scale * hit.end;
    hits_.push_back({end.x(), end.y(), hit.normal.x(), hit.normal.y()});
    const float squared = end.squaredNorm();
    sum += squared, farthest = std::max(farthest, squared);
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, hits_.size()));
  reach_ = std::max(1.0, std::sqrt(sum / n));
  const double beams = std::min(1.0, settings_.effective_beams / n);
  const double sigma = settings_.sigma / settings_.resolution;  // [cells]
  scale_ = beams / (sigma * sigma);
  window_.open(map, about.x * scale, about.y * scale, std::sqrt(farthest) + kMargin);
}

ScanMatcher::Vector ScanMatcher::inWindow(const Pose2& pose) const {
  return {pose.x / settings_.resolution - window_.cornerX(), pose.y / settings_.resolution - window_.cornerY(),
          pose.yaw};
}

Pose2 ScanMatcher::inMap(const Vector& v) const {
  return {(v.x() + window_.cornerX()) * settings_.resolution, (v.y() + window_.cornerY()) * settings_.resolution,
          angleDifference(v.z(), 0.0)};
}

void ScanMatcher::setPrior(const PosePrior& prior) {
  const Eigen::Vector3d unit(settings_.resolution, settings_.resolution, 1.0);
  prior_mean_ = inWindow(prior.mean);
  prior_information_ = unit.asDiagonal() * prior.covariance.inverse() * unit.asDiagonal();
}

double ScanMatcher::priorCost(const Vector& v) const {
  const Vector d = v - prior_mean_;
  return 0.5 * d.dot(prior_information_ * d);
}

/// Beyond the end of what is known of a wall, the wall goes on where nobody has looked yet: no reason to pull the
/// scan back.
template <class... Where>
auto ScanMatcher::missAt(const Wall& nearest, int x, int y, const Where&... where) const {
  Miss miss(nearest, x, y, where...);
  if (miss.along != 0.f && miss.wall && !window_.seen(x, y)) miss.along = 0.f;
  return miss;
}

/// Geman and McClure's: 1/2 r^2 / (1 + r^2 / outlier^2), r and outlier in cells; so without `scale_`.
double ScanMatcher::cost(const Vector& v, float outlier) {
  const auto c = static_cast<float>(std::cos(v.z())), s = static_cast<float>(std::sin(v.z()));
  const auto x0 = static_cast<float>(v.x()), y0 = static_cast<float>(v.y());
  const float limit = outlier * outlier;
  float sum = 0.f;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const float px = c * hits_[i].x - s * hits_[i].y + x0, py = s * hits_[i].x + c * hits_[i].y + y0;
    const int x = static_cast<int>(px), y = static_cast<int>(py);  // the window's coordinates are positive
    if (const Wall* nearest = window_.nearest(x, y)) {
      const float r2 = missAt(*nearest, x, y, px, py, hits_[i], c, s).squared();
      sum += limit * r2 / (limit + r2);
    } else {
      sum += window_.seen(x, y) ? limit : static_cast<float>(kUnseen) * limit;
    }
  }
  score_ = static_cast<double>(hits_.size()) - sum / limit;
  return 0.5 * sum;
}

ScanMatcher::Normal ScanMatcher::normal(const Vector& v, float outlier) {
  const auto c = static_cast<float>(std::cos(v.z())), s = static_cast<float>(std::sin(v.z()));
  const auto x0 = static_cast<float>(v.x()), y0 = static_cast<float>(v.y());
  const float limit = outlier * outlier;
  float xx = 0, xy = 0, xt = 0, yy = 0, yt = 0, tt = 0, gx = 0, gy = 0, gt = 0;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const float vx = c * hits_[i].x - s * hits_[i].y, vy = s * hits_[i].x + c * hits_[i].y, px = vx + x0, py = vy + y0;
    const int x = static_cast<int>(px), y = static_cast<int>(py);  // the window's coordinates are positive
    const Wall* nearest = window_.nearest(x, y);
    if (!nearest) continue;
    const Miss miss = missAt(*nearest, x, y, px, py, hits_[i], c, s);
    const float share = limit / (limit + miss.squared()), weight = share * share;
    const auto add = [&](float r, float jx, float jy) {
      const float jt = jy * vx - jx * vy;
      xx += weight * jx * jx, xy += weight * jx * jy, xt += weight * jx * jt;
      yy += weight * jy * jy, yt += weight * jy * jt, tt += weight * jt * jt;
      gx += weight * r * jx, gy += weight * r * jy, gt += weight * r * jt;
    };
    add(miss.across, miss.nx, miss.ny);
    if (miss.along != 0.f) add(miss.along, -miss.ny, miss.nx);
  }
  Normal out;
  out.information << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  out.information = scale_ * out.information + prior_information_;
  out.slope = scale_ * Vector(gx, gy, gt) + prior_information_ * (v - prior_mean_);
  return out;
}

/// Cost of the thinned scan, turned already, moved by whole cells: squared distances to what is nearest, none
/// above `limit`. Infinite where it is no less than `most`, which is known early.
float ScanMatcher::roughCost(int dx, int dy, float limit, float most) {
  constexpr std::size_t kStride = 16;
  float sum = 0.f;
  for (std::size_t i = 0; i < rough_.size(); i += kStride) {
    if (!(sum < most)) return std::numeric_limits<float>::infinity();
    for (std::size_t k = i; k < std::min(rough_.size(), i + kStride); ++k) {
      const RoughPoint& p = rough_[k];
      const int x = p.cell_x + dx, y = p.cell_y + dy;
      if (const Wall* nearest = window_.nearest(x, y)) {
        const float u = p.x + static_cast<float>(dx) - FieldWindow::tileCorner(x) - nearest->x;
        const float v = p.y + static_cast<float>(dy) - FieldWindow::tileCorner(y) - nearest->y;
        sum += std::min(limit, u * u + v * v);
      } else {
        sum += limit;
      }
    }
  }
  return sum;
}

/// The best of a lattice over what odometry leaves open, by some of the beams; so that a wall is not taken for
/// its neighbour.
ScanMatcher::Vector ScanMatcher::search(const PosePrior& prior) {
  constexpr std::size_t kBeams = 90;
  constexpr int kStep = 4;       // [cells]
  constexpr float kLimit = 36.f; // [cells^2]: wide, so that a near miss counts
  const std::size_t stride = std::max<std::size_t>(1, hits_.size() / kBeams);
  const double step_yaw = kStep / reach_;
  const auto steps = [](double sigma, double step, int most) {
    return std::clamp(static_cast<int>(std::ceil(2.0 * sigma / step - 0.5)), 0, most);
  };
  const double sigma = std::sqrt(std::max(prior.covariance(0, 0), prior.covariance(1, 1)));
  const int n = steps(sigma / settings_.resolution, kStep, 4), m = steps(std::sqrt(prior.covariance(2, 2)), step_yaw, 10);
  Vector best = prior_mean_;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](int i, int j, int t) {
    const Vector v = prior_mean_ + Vector(kStep * i, kStep * j, step_yaw * t);
    const double scale = 0.5 * scale_ * static_cast<double>(hits_.size()) / static_cast<double>(rough_.size());
    const double prior_cost = priorCost(v), most = (least - prior_cost) / scale;
    const double at = scale * roughCost(kStep * i, kStep * j, kLimit, static_cast<float>(most)) + prior_cost;
    if (at < least) least = at, best = v;
  };
  for (int t = 0; t <= 2 * m; ++t) {  // from the middle outwards: what is near what odometry says rules out the rest early
    const int turn = t % 2 == 0 ? t / 2 : -(t + 1) / 2;
    turnRough(prior_mean_.z() + step_yaw * turn, stride);
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) consider(i, j, turn);
  }
  return best;
}

void ScanMatcher::turnRough(double yaw, std::size_t stride) {
  const auto c = static_cast<float>(std::cos(yaw)), s = static_cast<float>(std::sin(yaw));
  const auto x0 = static_cast<float>(prior_mean_.x()), y0 = static_cast<float>(prior_mean_.y());
  rough_.clear();
  for (std::size_t i = 0; i < hits_.size(); i += stride) {
    const float px = c * hits_[i].x - s * hits_[i].y + x0, py = s * hits_[i].x + c * hits_[i].y + y0;
    rough_.push_back({static_cast<int>(px), static_cast<int>(py), px, py});
  }
}

/// Gauss-Newton on the nearest walls, outliers cut off more and more tightly.
ScanMatcher::Vector ScanMatcher::descend(Vector v) {
  for (const float widened : {2.f, 1.f}) {
    for (int i = 0; i < 8; ++i) {
      const Normal n = normal(v, widened * outlier_);
      const Vector step = -n.information.ldlt().solve(n.slope);
      const double moved = std::max({std::abs(step.x()), std::abs(step.y()), reach_ * std::abs(step.z())});
      if (!std::isfinite(moved)) return v;
      v += step * std::min(1.0, 4.0 / moved);
      if (moved < 0.02) break;
    }
  }
  return v;
}

/// The lattice may be misled where a scan says little, along a corridor; so what odometry says is tried too.
ScanMatcher::Vector ScanMatcher::best(const PosePrior& prior) {
  const auto at = [&](const Vector& v) { return scale_ * cost(v, outlier_) + priorCost(v); };
  const Vector start = search(prior), near = descend(prior_mean_);
  if (start == prior_mean_) return near;
  const Vector far = descend(start);
  return at(far) < at(near) ? far : near;
}

/// Gauss-Hermite points of the normal that the curvature at the peak gives, each weighed by what is really
/// there: exact for a normal, and right to see where the walls end.
void ScanMatcher::sample(const Vector& peak, Match& out) {
  const Normal n = normal(peak, outlier_);
  const Eigen::Matrix3d spread = n.information.inverse().llt().matrixL();
  const double least = scale_ * cost(peak, outlier_) + priorCost(peak);
  out.score = score_;
  double mass = 0.0;
  Vector mean = Vector::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 27; ++k) {
    const Vector z = std::sqrt(3.0) * Vector(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    double share = 1.0;
    for (int a = 0; a < 3; ++a) share *= z[a] == 0.0 ? 2.0 / 3.0 : 1.0 / 6.0;
    const Vector d = spread * z;
    const double above = scale_ * cost(peak + d, outlier_) + priorCost(peak + d) - least;
    const double weight = share * std::exp(0.5 * z.squaredNorm() - std::max(0.0, above));
    mass += weight, mean += weight * d, square += weight * d * d.transpose();
  }
  mean /= mass;
  const Eigen::Vector3d unit(settings_.resolution, settings_.resolution, 1.0);
  out.mean = inMap(peak + mean);
  out.covariance = unit.asDiagonal() * (square / mass - mean * mean.transpose()) * unit.asDiagonal();
  out.log_evidence = std::log(mass * spread.diagonal().prod()) - least +
                     0.5 * std::log(prior_information_.determinant());
}

Pose2 ScanMatcher::peak(const SlamScan& scan, TileMap& map, const PosePrior& prior) {
  open(scan, map, prior.mean);
  setPrior(prior);
  return inMap(best(prior));
}

Match ScanMatcher::match(const SlamScan& scan, TileMap& map, const PosePrior& prior) {
  open(scan, map, prior.mean);
  setPrior(prior);
  const Vector peak = best(prior);
  Match out;
  out.peak = inMap(peak);
  sample(peak, out);
  return out;
}

double ScanMatcher::logLikelihood(const SlamScan& scan, TileMap& map, const Pose2& T_map_base, double* score) {
  open(scan, map, T_map_base);
  const double at = scale_ * cost(inWindow(T_map_base), outlier_);
  if (score) *score = score_;
  return -at;
}

}  // namespace field_fusion::core
