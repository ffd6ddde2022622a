#include "field_fusion/core/scan/vicp.h"

#include <pcl/kdtree/kdtree_flann.h>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core {
namespace {

constexpr double kSilence = 0.5;         // [s]
constexpr std::size_t kFewest = 20;      // pairs that tell three unknowns
constexpr double kLeastShare = 0.3;      // of the points that must have a partner
constexpr double kStillPlace = 5e-5;     // [m], [rad]: a step of ICP that no longer matters
constexpr double kStillVelocity = 5e-3;  // [m/s], [rad/s]: an update that no longer matters

Eigen::Isometry2d motionOf(double x, double y, double angle) {
  Eigen::Isometry2d out = Eigen::Isometry2d::Identity();
  out.linear() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  out.translation() << x, y;
  return out;
}

double angleOf(const Eigen::Isometry2d& motion) { return std::atan2(motion(1, 0), motion(0, 0)); }

/// V of exp([turn, way]) = [R, V way] at the angle of the turn.
Eigen::Matrix2d leftJacobian(double angle) {
  const double a = std::abs(angle) < 1e-6 ? 1.0 : std::sin(angle) / angle;
  const double b = std::abs(angle) < 1e-6 ? 0.5 * angle : (1.0 - std::cos(angle)) / angle;
  return (Eigen::Matrix2d() << a, -b, b, a).finished();
}

/// A point, its partner in the scan before, and across the line on which that lies.
struct Pair {
  Eigen::Vector2d from, to, normal;
};

/// The motion that brings the points onto their partners (Arun, Huang and Blostein 1987, in the plane).
Eigen::Isometry2d toPoints(const std::vector<Pair>& pairs) {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  for (const Pair& p : pairs) from += p.from, to += p.to;
  from /= static_cast<double>(pairs.size()), to /= static_cast<double>(pairs.size());
  double along = 0.0, across = 0.0;
  for (const Pair& p : pairs) {
    const Eigen::Vector2d a = p.from - from, b = p.to - to;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const double angle = std::atan2(across, along);
  const Eigen::Vector2d way = to - Eigen::Rotation2Dd(angle) * from;
  return motionOf(way.x(), way.y(), angle);
}

/// The same onto their lines, for a small turn.
Eigen::Isometry2d toLines(const std::vector<Pair>& pairs) {
  Eigen::Matrix3d left = Eigen::Matrix3d::Identity() * 1e-9;  // a corridor says nothing of the way along it
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Pair& p : pairs) {
    const Eigen::Vector3d row(p.normal.x(), p.normal.y(),
                              p.from.x() * p.normal.y() - p.from.y() * p.normal.x());
    left += row * row.transpose();
    right += row * p.normal.dot(p.to - p.from);
  }
  const Eigen::Vector3d step = left.ldlt().solve(right);
  return motionOf(step.x(), step.y(), step.z());
}

}  // namespace

Eigen::Isometry2d planarMotion(const PlanarVelocity& velocity, double time) {
  const double angle = velocity.turn * time;
  const Eigen::Vector2d way = leftJacobian(angle) * Eigen::Vector2d(velocity.x, velocity.y) * time;
  return motionOf(way.x(), way.y(), angle);
}

PlanarVelocity planarVelocity(const Eigen::Isometry2d& motion, double time) {
  const double angle = angleOf(motion);
  const Eigen::Vector2d way = leftJacobian(angle).inverse() * motion.translation();
  return {way.x() / time, way.y() / time, angle / time};
}

struct Vicp::Model {
  explicit Model(const std::vector<Eigen::Vector2d>& points) : cloud(new pcl::PointCloud<pcl::PointXYZ>) {
    for (const auto& p : points)
      cloud->push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), 0.f});
    if (!cloud->empty()) tree.setInputCloud(cloud);
  }

  /// The nearest of the scan before; false where it is farther than `distance` [m].
  bool find(const Eigen::Vector2d& from, double distance, Pair& pair) {
    if (cloud->size() < 2) return false;
    const pcl::PointXYZ at(static_cast<float>(from.x()), static_cast<float>(from.y()), 0.f);
    if (tree.nearestKSearch(at, 2, index, squared) < 2 || squared[0] > distance * distance) return false;
    const auto place = [this](int i) { return Eigen::Vector2d((*cloud)[i].x, (*cloud)[i].y); };
    pair.from = from;
    pair.to = place(index[0]);
    const Eigen::Vector2d line = place(index[1]) - pair.to;
    pair.normal = Eigen::Vector2d(-line.y(), line.x());
    if (line.norm() > 0.0) pair.normal /= line.norm();
    return true;
  }

  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  std::vector<int> index = std::vector<int>(2);
  std::vector<float> squared = std::vector<float>(2);
};

Vicp::Vicp(const VicpParams& params) { setParams(params); }
Vicp::~Vicp() = default;

void Vicp::setParams(const VicpParams& params) { params_ = checked(params); }

void Vicp::reset() {
  model_.reset();
  velocity_ = {};
}

void Vicp::undistort(const Cloud& points) {
  now_.clear();
  for (const Point& p : points) now_.push_back(planarMotion(velocity_, p.time) * Eigen::Vector2d(p.x, p.y));
}

std::optional<Eigen::Isometry2d> Vicp::icp(Eigen::Isometry2d T_before_now) const {
  std::vector<Pair> pairs;
  for (int i = 0; i < params_.iterations; ++i) {
    pairs.clear();
    Pair pair;
    for (const auto& p : now_)
      if (model_->find(T_before_now * p, params_.max_distance, pair)) pairs.push_back(pair);
    if (pairs.size() < kFewest ||
        static_cast<double>(pairs.size()) < kLeastShare * static_cast<double>(now_.size()))
      return std::nullopt;
    const auto step = params_.metric == VicpParams::Metric::kPoint ? toPoints(pairs) : toLines(pairs);
    T_before_now = step * T_before_now;
    if (step.translation().norm() < kStillPlace && std::abs(angleOf(step)) < kStillPlace) break;
  }
  return T_before_now;
}

std::optional<PlanarVelocity> Vicp::run(const Cloud& points, double stamp) {
  const double span = stamp - stamp_;
  const bool first = !model_ || !(span > 0.0 && span <= kSilence);
  if (first) velocity_ = {};
  bool found = !first;
  updates_ = 0;
  for (bool moving = found; moving && updates_ < params_.updates; ++updates_) {
    undistort(points);
    const auto T_before_now = icp(planarMotion(velocity_, span));
    if (!(found = T_before_now.has_value())) break;
    const PlanarVelocity old = velocity_;
    velocity_ = planarVelocity(*T_before_now, span);
    moving = std::hypot(velocity_.x - old.x, velocity_.y - old.y) > kStillVelocity ||
             std::abs(velocity_.turn - old.turn) > kStillVelocity;
  }
  if (!found) velocity_ = {};
  undistort(points);
  model_ = std::make_unique<Model>(now_);
  stamp_ = stamp;
  return found ? std::optional(velocity_) : std::nullopt;
}

}  // namespace field_fusion::core
