#include "field_fusion/core/sim/image_truth.h"

#include <algorithm>

namespace field_fusion::core::sim {
namespace {

BodyView viewOf(int body, const ImageTruth::Count& seen, const ImageTruth::Count& alone, cv::Size picture) {
  BodyView view;
  view.body = body;
  view.box = alone.box(), view.visible_box = seen.box();
  view.visible = static_cast<double>(seen.number) / alone.number;
  view.cut = cutBits(view.box, picture, 0.f);
  return view;
}

}  // namespace

void ImageTruth::Count::add(int u, int v) {
  ++number;
  low = {std::min(low.x, u), std::min(low.y, v)}, high = {std::max(high.x, u), std::max(high.y, v)};
}

void ImageTruth::Count::add(const Count& other) {
  number += other.number;
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
}

ImageBox ImageTruth::Count::box() const {
  if (number == 0) return {};
  return {static_cast<float>(low.x), static_cast<float>(low.y), static_cast<float>(high.x + 1),
          static_cast<float>(high.y + 1)};
}

ImageTruth::ImageTruth(const World& world, const Lens& lens) : world_(world), lens_(lens) {
  for (const Body& body : world.bodies) outlines_.emplace_back(body.model);
}

/// Pixels of the row that show something else are cast at the body alone.
void ImageTruth::count(const Shot& shot, Stretch& s, Scratch& scratch) const {
  const int* shown = shot.bodies.ptr<int>(s.row);
  scratch.rays.clear(), scratch.columns.clear();
  for (int u = s.first; u < s.last; ++u) {
    if (shown[u] == s.body) {
      s.seen.add(u, s.row), s.alone.add(u, s.row);
      continue;
    }
    scratch.rays.push_back({shot.T.translation(), shot.T.linear() * lens_.ray(u, s.row), 0.f});
    scratch.columns.push_back(u);
  }
  scratch.ranges.resize(scratch.rays.size());
  shot.caster.rangesTo(s.body, scratch.rays.data(), scratch.ranges.data(), scratch.rays.size());
  for (std::size_t i = 0; i < scratch.rays.size(); ++i)
    if (std::isfinite(scratch.ranges[i])) s.alone.add(scratch.columns[i], s.row);
}

void ImageTruth::findStretches(const Transform& T_world_optical, double time) {
  stretches_.clear();
  const Transform T_optical_world = T_world_optical.inverse();
  for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
    const Body& body = world_.bodies[i];
    if (body.label.empty()) continue;
    const cv::Rect rect = outlines_[i].rect(body.model, T_optical_world * body.way.pose(time), time, lens_);
    for (int v = rect.y; v < rect.y + rect.height; ++v)
      stretches_.push_back({static_cast<int>(i), v, rect.x, rect.x + rect.width, {}, {}});
  }
}

std::vector<BodyView> ImageTruth::views(const Caster& caster, const Transform& T_world_optical, double time,
                                        const cv::Mat& bodies, Workers& workers) {
  findStretches(T_world_optical, time);
  scratch_.resize(static_cast<std::size_t>(workers.number()));
  const Shot shot{caster, T_world_optical.cast<float>(), bodies};
  workers.share(stretches_.size(), [&](std::size_t i, int worker) {
    count(shot, stretches_[i], scratch_[static_cast<std::size_t>(worker)]);
  });
  std::vector<BodyView> views;
  for (auto s = stretches_.begin(); s != stretches_.end();) {
    const int body = s->body;
    Count seen, alone;
    for (; s != stretches_.end() && s->body == body; ++s) seen.add(s->seen), alone.add(s->alone);
    if (alone.number > 0) views.push_back(viewOf(body, seen, alone, bodies.size()));
  }
  return views;
}

}  // namespace field_fusion::core::sim
