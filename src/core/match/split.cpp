#include "field_fusion/core/match/split.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

constexpr double kSameBody = 0.3;       // of the smaller box's area
constexpr double kTooWide = 2.0;        // times the width of the only box
constexpr std::size_t kMostBoxes = 16;  // that are tried on one body

/// Shared area over the smaller area, of tangents.
double overlap(const ViewBox& a, const ViewBox& b) {
  const double width = std::min(a.left, b.left) - std::max(a.right, b.right);
  const double height = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
  const auto area = [](const ViewBox& box) { return (box.left - box.right) * (box.top - box.bottom); };
  return width > 0.0 && height > 0.0 ? width * height / std::min(area(a), area(b)) : 0.0;
}

/// From the middle of the box: 1 on its border. Infinite behind the camera.
double offCentre(const ViewBox& box, const Eigen::Vector3d& point) {
  if (!(point.x() > 0.0)) return std::numeric_limits<double>::infinity();
  const auto off = [](double at, double low, double high) {
    return std::abs(2.0 * at - low - high) / (high - low);
  };
  return std::max(off(point.y() / point.x(), box.right, box.left),
                  off(point.z() / point.x(), box.bottom, box.top));
}

bool hasArea(const ViewBox& box) { return box.known() && box.left > box.right && box.top > box.bottom; }

}  // namespace

void Splitter::setParams(const SplitParams& params, const Gate& gate, double margin) {
  part_points_ = static_cast<std::size_t>(params.part_points);
  gate_ = gate;
  margin_ = margin;
}

void Splitter::run(std::vector<LidarTarget>& bodies, const std::vector<Point>& points,
                   const CameraView& view) {
  findSharers(bodies, view);
  result_.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    dropSecondOpinions(sharers_[b]);
    if (!bodies[b].joined.empty() || !split(bodies[b], points, view.T_view_lidar, sharers_[b])) {
      result_.push_back(std::move(bodies[b]));
      continue;
    }
    for (Part& part : parts_) result_.push_back(std::move(part.body));
  }
  for (std::size_t b = 1; b < result_.size(); ++b)  // parts of one cluster stand side by side
    if (result_[b].part != 0 && result_[b].place == result_[b - 1].place)
      result_[b].part = result_[b - 1].part + 1;
  bodies.swap(result_);
}

void Splitter::findSharers(const std::vector<LidarTarget>& bodies, const CameraView& view) {
  std::vector<Sight> sights;
  for (const LidarTarget& body : bodies) sights.push_back(sightOf(body.cluster, view.T_view_lidar));
  sharers_.assign(bodies.size(), {});
  for (const CameraTarget& target : view.targets) {
    if (!hasArea(target.box)) continue;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Likeness likeness = gate_.compare(sights[b], target);
      if (!likeness.inside || likeness.cost >= least) continue;
      least = likeness.cost;
      best = static_cast<int>(b);
    }
    if (best >= 0) sharers_[best].push_back(&target);
  }
}

void Splitter::dropSecondOpinions(std::vector<const CameraTarget*>& boxes) const {
  const auto second = [&](const CameraTarget* box) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const CameraTarget* other) {
      const bool better = std::make_pair(-other->score, other->id) < std::make_pair(-box->score, box->id);
      return better && overlap(other->box, box->box) > kSameBody;
    });
  };
  std::vector<const CameraTarget*> kept;
  std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(kept), [&](auto* box) { return !second(box); });
  std::sort(kept.begin(), kept.end(), [](auto* a, auto* b) {
    return std::make_pair(-a->score, a->id) < std::make_pair(-b->score, b->id);
  });
  kept.resize(std::min(kept.size(), kMostBoxes));
  std::sort(kept.begin(), kept.end());  // as the targets stand
  boxes.swap(kept);
}

bool Splitter::tooWide(const LidarTarget& body, const ViewBox& box, const Transform& T_view_lidar) const {
  return sightOf(body.cluster, T_view_lidar).width > kTooWide * (box.width() + 2.0 * margin_);
}

bool Splitter::split(const LidarTarget& body, const std::vector<Point>& points, const Transform& T_view_lidar,
                     std::vector<const CameraTarget*> boxes) {
  while (boxes.size() >= 2 || (boxes.size() == 1 && tooWide(body, boxes.front()->box, T_view_lidar))) {
    parts_.clear();
    for (const CameraTarget* box : boxes) parts_.push_back({box, {{}, body.place, 1, {}}});
    parts_.push_back({nullptr, {{}, body.place, 1, {}}});
    deal(body, points, T_view_lidar, true);
    if (parts_.back().body.members.size() < part_points_) {
      if (boxes.size() == 1) return false;
      deal(body, points, T_view_lidar, false);
    }
    OrientedBoxFitter* fitter = std::isfinite(body.cluster.oriented_box.yaw) ? &box_fitter_ : nullptr;
    for (Part& part : parts_)
      if (!part.body.members.empty()) describeMembers(part.body, points, fitter);
    const CameraTarget* const bad = failing(T_view_lidar);
    if (!bad) {
      if (parts_.back().body.members.empty()) parts_.pop_back();
      return true;
    }
    boxes.erase(std::find(boxes.begin(), boxes.end(), bad));
  }
  return false;
}

void Splitter::deal(const LidarTarget& body, const std::vector<Point>& points, const Transform& T_view_lidar,
                    bool with_rest) {
  for (Part& part : parts_) part.body.members.clear();
  forEachPoint(body, [&](std::uint32_t i) {
    const Eigen::Vector3d point = T_view_lidar * points[i].position().cast<double>();
    Part* nearest = &parts_.front();
    double least = std::numeric_limits<double>::infinity();
    for (Part& part : parts_) {
      if (!part.target) continue;
      const double off = offCentre(part.target->box, point);
      if (off < least) least = off, nearest = &part;
    }
    if (with_rest && !nearest->target->box.contains(point, margin_)) nearest = &parts_.back();
    nearest->body.members.push_back(i);
  });
}

const CameraTarget* Splitter::failing(const Transform& T_view_lidar) const {
  for (const Part& part : parts_) {
    if (!part.target) continue;
    const bool enough = part.body.members.size() >= part_points_;
    if (!enough || !gate_.compare(sightOf(part.body.cluster, T_view_lidar), *part.target).inside)
      return part.target;
  }
  return nullptr;
}

}  // namespace field_fusion::core
