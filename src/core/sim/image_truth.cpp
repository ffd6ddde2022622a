#include "field_fusion/core/sim/image_truth.h"

#include <algorithm>

namespace field_fusion::core::sim {
namespace {

/// Pixels of a body.
struct Count {
  int number = 0;
  cv::Point low{1 << 30, 1 << 30}, high{-1, -1};

  void add(int u, int v) {
    ++number;
    low = {std::min(low.x, u), std::min(low.y, v)}, high = {std::max(high.x, u), std::max(high.y, v)};
  }
  ImageBox box() const {
    if (number == 0) return {};
    return {static_cast<float>(low.x), static_cast<float>(low.y), static_cast<float>(high.x + 1),
            static_cast<float>(high.y + 1)};
  }
};

struct Job {
  int body;
  cv::Rect rect;
  Count seen, alone;
};

/// Pixels of a row that show something else are cast at the body alone.
void count(Job& job, const Caster& caster, const Lens& lens, const Eigen::Isometry3f& T_world_optical,
           const cv::Mat& bodies) {
  std::vector<Ray> rays;
  std::vector<int> columns;
  std::vector<float> ranges;
  for (int v = job.rect.y; v < job.rect.y + job.rect.height; ++v) {
    const int* shown = bodies.ptr<int>(v);
    rays.clear(), columns.clear();
    for (int u = job.rect.x; u < job.rect.x + job.rect.width; ++u) {
      if (shown[u] == job.body) {
        job.seen.add(u, v), job.alone.add(u, v);
        continue;
      }
      rays.push_back({T_world_optical.translation(), T_world_optical.linear() * lens.ray(u, v), 0.f});
      columns.push_back(u);
    }
    ranges.resize(rays.size());
    caster.rangesTo(job.body, rays.data(), ranges.data(), rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (std::isfinite(ranges[i])) job.alone.add(columns[i], v);
  }
}

BodyView viewOf(const Job& job, cv::Size picture) {
  BodyView view;
  view.body = job.body;
  view.box = job.alone.box(), view.visible_box = job.seen.box();
  view.visible = static_cast<double>(job.seen.number) / job.alone.number;
  view.cut = cutBits(view.box, picture, 0.f);
  return view;
}

}  // namespace

ImageTruth::ImageTruth(const World& world, const Lens& lens) : world_(world), lens_(lens) {
  for (const Body& body : world.bodies) outlines_.emplace_back(body.model);
}

std::vector<BodyView> ImageTruth::views(const Caster& caster, const Transform& T_world_optical, double time,
                                        const cv::Mat& bodies, Workers& workers) const {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
    const Body& body = world_.bodies[i];
    if (body.label.empty()) continue;
    const Transform T_optical_body = T_world_optical.inverse() * body.way.pose(time);
    const cv::Rect rect = outlines_[i].rect(body.model, T_optical_body, time, lens_);
    if (!rect.empty()) jobs.push_back({static_cast<int>(i), rect, {}, {}});
  }
  const Eigen::Isometry3f T = T_world_optical.cast<float>();
  workers.share(jobs.size(), [&](std::size_t j, int) { count(jobs[j], caster, lens_, T, bodies); });
  std::vector<BodyView> views;
  for (const Job& job : jobs)
    if (job.alone.number > 0) views.push_back(viewOf(job, bodies.size()));
  return views;
}

}  // namespace field_fusion::core::sim
