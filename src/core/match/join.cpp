#include "field_fusion/core/match/join.h"

#include <algorithm>
#include <numeric>

namespace field_fusion::core {
namespace {

constexpr double kInside = 0.7;  // share of a cluster's points in the box
constexpr double kSlack = 0.1;   // [m] by which noise makes a body larger

std::size_t countOf(const LidarTarget& body) {
  return body.members.empty() ? body.cluster.points.count : body.members.size();
}

double areaOf(const ViewBox& box) { return (box.left - box.right) * (box.top - box.bottom); }

std::vector<int> smallestFirst(const std::vector<CameraTarget>& targets) {
  std::vector<int> order;
  for (std::size_t t = 0; t < targets.size(); ++t)
    if (areaOf(targets[t].box) > 0.0) order.push_back(static_cast<int>(t));  // NaN is not
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return areaOf(targets[a].box) < areaOf(targets[b].box); });
  return order;
}

}  // namespace

void Joiner::setParams(const ShapeParams& params, const Gate& gate, double margin) {
  params_ = params;
  gate_ = gate;
  margin_ = margin;
}

void Joiner::run(std::vector<LidarTarget>& bodies, const std::vector<Point>& points, const CameraView& view) {
  taken_.assign(bodies.size(), 0);
  gone_.assign(bodies.size(), 0);
  for (const int t : smallestFirst(view.targets)) {
    const CameraTarget& target = view.targets[t];
    std::vector<int> candidates = inside(bodies, points, target, view.T_view_lidar);
    const int main = mainOf(candidates, bodies, target, view.T_view_lidar);
    if (main < 0) continue;
    taken_[main] = 1;
    const ClassShape shape = shapeOf(target.label, params_);
    if (!shape.isKnown()) continue;
    const double largest = shape.extent() * (1.0 + params_.size_spread) + kSlack;
    const auto group = fitting(main, std::move(candidates), bodies, points, largest);
    if (group.size() > 1) join(group, bodies, points);
  }
  std::size_t kept = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!gone_[b]) {
      if (kept != b) bodies[kept] = std::move(bodies[b]);
      ++kept;
    }
  bodies.resize(kept);
}

/// Those that no smaller box has taken.
std::vector<int> Joiner::inside(const std::vector<LidarTarget>& bodies, const std::vector<Point>& points,
                                const CameraTarget& target, const Transform& T_view_lidar) const {
  std::vector<int> out;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (taken_[b]) continue;
    std::size_t in = 0;
    forEachPoint(bodies[b], [&](std::uint32_t i) {
      in += target.box.contains(T_view_lidar * points[i].position().cast<double>(), margin_);
    });
    if (static_cast<double>(in) > kInside * static_cast<double>(countOf(bodies[b])))
      out.push_back(static_cast<int>(b));
  }
  return out;
}

int Joiner::mainOf(const std::vector<int>& candidates, const std::vector<LidarTarget>& bodies,
                   const CameraTarget& target, const Transform& T_view_lidar) const {
  int likeliest = -1, largest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int b : candidates) {
    const Likeness likeness = gate_.compare(sightOf(bodies[b].cluster, T_view_lidar), target);
    if (likeness.inside && likeness.cost < least) least = likeness.cost, likeliest = b;
    if (largest < 0 || countOf(bodies[b]) > countOf(bodies[largest])) largest = b;
  }
  return likeliest >= 0 ? likeliest : largest;
}

std::vector<int> Joiner::fitting(int main, std::vector<int> candidates,
                                 const std::vector<LidarTarget>& bodies, const std::vector<Point>& points,
                                 double largest) const {
  const Eigen::Vector2f centre = bodies[main].cluster.centre.head<2>(), along = centre.normalized();
  const auto away = [&](int b) { return (bodies[b].cluster.centre.head<2>() - centre).squaredNorm(); };
  std::stable_sort(candidates.begin(), candidates.end(), [&](int a, int b) { return away(a) < away(b); });
  const auto boxOf = [&](int b) {
    Eigen::AlignedBox2f box;
    forEachPoint(bodies[b], [&](std::uint32_t i) {
      const Eigen::Vector2f p = points[i].position().head<2>() - centre;
      box.extend(Eigen::Vector2f(along.dot(p), along.x() * p.y() - along.y() * p.x()));
    });
    return box;
  };
  Eigen::AlignedBox2f all = boxOf(main);
  std::vector<int> group{main};
  for (const int b : candidates) {
    if (b == main) continue;
    const Eigen::AlignedBox2f with = all.merged(boxOf(b));
    if (with.sizes().maxCoeff() > static_cast<float>(largest)) continue;
    all = with;
    group.push_back(b);
  }
  return group;
}

void Joiner::join(const std::vector<int>& group, std::vector<LidarTarget>& bodies,
                  const std::vector<Point>& points) {
  LidarTarget whole;
  whole.place = bodies[group.front()].place;
  for (const int b : group) {
    taken_[b] = 1;
    gone_[b] = b != group.front();
    forEachPoint(bodies[b], [&](std::uint32_t i) { whole.members.push_back(i); });
    if (gone_[b]) whole.joined.push_back(bodies[b].place);
  }
  const bool oriented = std::isfinite(bodies[group.front()].cluster.oriented_box.yaw);
  describeMembers(whole, points, oriented ? &box_fitter_ : nullptr);
  bodies[group.front()] = std::move(whole);
}

}  // namespace field_fusion::core
