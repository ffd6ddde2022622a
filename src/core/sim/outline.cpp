#include "field_fusion/core/sim/outline.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core::sim {
namespace {

struct Extender {
  Eigen::AlignedBox3d& box;

  void operator()(const Mesh& mesh) const {
    for (const Eigen::Vector3f& p : mesh.vertices) box.extend(p.cast<double>());
  }
  void operator()(const Sphere& s) const {
    box.extend((s.centre.array() - s.radius).matrix().cast<double>());
    box.extend((s.centre.array() + s.radius).matrix().cast<double>());
  }
  void operator()(const Cylinder& c) const {
    for (const Eigen::Vector3f& end : {c.foot, Eigen::Vector3f(c.foot + c.axis)}) {
      box.extend((end.array() - c.radius).matrix().cast<double>());
      box.extend((end.array() + c.radius).matrix().cast<double>());
    }
  }
};

constexpr double kNear = 1e-3;  // [m] nothing is seen nearer

/// The twelve edges of a box as places of their ends among its corners.
constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/// Points of an edge, in front; the lens bends it between.
void extend(Eigen::AlignedBox2d& rect, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Lens& lens) {
  if (a.z() < kNear && b.z() < kNear) return;
  const double at = (kNear - a.z()) / (b.z() - a.z());
  const double first = a.z() < kNear ? at : 0.0, last = b.z() < kNear ? at : 1.0;
  constexpr int kPieces = 8;
  for (int i = 0; i <= kPieces; ++i) {
    Eigen::Vector3d p = a + (first + (last - first) * i / kPieces) * (b - a);
    p.z() = std::max(p.z(), kNear);
    rect.extend(lens.project(p));
  }
}

}  // namespace

Outline::Outline(const Model& model) {
  for (const Link& link : model.links) {
    links_.emplace_back();
    for (const Part& part : link.parts) std::visit(Extender{links_.back()}, part.shape);
  }
}

cv::Rect Outline::rect(const Model& model, const Transform& T_optical_body, double time,
                       const Lens& lens) const {
  Eigen::AlignedBox3d body;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].isEmpty()) continue;
    const Transform T_body_link = model.linkPose(i, time);
    for (int c = 0; c < 8; ++c)
      body.extend(T_body_link * links_[i].corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
  }
  const cv::Rect picture(0, 0, lens.width(), lens.height());
  if (body.isEmpty()) return {};
  if (body.contains(T_optical_body.inverse().translation())) return picture;
  Eigen::AlignedBox2d rect;
  Eigen::Vector3d corners[8];
  for (int c = 0; c < 8; ++c)
    corners[c] = T_optical_body * body.corner(static_cast<Eigen::AlignedBox3d::CornerType>(c));
  for (const auto& edge : kEdges) extend(rect, corners[edge[0]], corners[edge[1]], lens);
  if (rect.isEmpty()) return {};
  constexpr double kMargin = 2.0, kFar = 1e6;  // [px] edges are not quite straight between their points
  const Eigen::Vector2d low = (rect.min().array() - kMargin).floor().max(-kFar).min(kFar);
  const Eigen::Vector2d high = (rect.max().array() + kMargin).ceil().max(-kFar).min(kFar);
  return cv::Rect(cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
                  cv::Point(static_cast<int>(high.x()) + 1, static_cast<int>(high.y()) + 1)) &
         picture;
}

}  // namespace field_fusion::core::sim
