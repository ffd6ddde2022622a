#include <algorithm>
#include <stdexcept>

#include "embree.h"

namespace field_fusion::core::sim {
namespace {

bool equal(const Mesh& a, const Mesh& b) { return a.vertices == b.vertices && a.triangles == b.triangles; }
bool equal(const Sphere& a, const Sphere& b) { return a.centre == b.centre && a.radius == b.radius; }
bool equal(const Cylinder& a, const Cylinder& b) {
  return a.foot == b.foot && a.axis == b.axis && a.radius == b.radius;
}

/// As rays see them: where they are and how many pass.
bool equal(const Part& a, const Part& b) {
  if (a.material.transparency != b.material.transparency || a.shape.index() != b.shape.index()) return false;
  return std::visit(
      [&](const auto& shape) { return equal(shape, std::get<std::decay_t<decltype(shape)>>(b.shape)); },
      a.shape);
}

void check(bool good, const char* wrong) {
  if (!good) throw std::invalid_argument(wrong);
}

struct Checker {
  void operator()(const Mesh& mesh) const {
    check(!mesh.triangles.empty(), "a mesh has no triangles");
    for (const Eigen::Vector3f& p : mesh.vertices)
      check(p.allFinite(), "a mesh has a vertex that is not finite");
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t i : triangle)
        check(i < mesh.vertices.size(), "a mesh's triangle names a vertex that is not there");
  }
  void operator()(const Sphere& s) const {
    check(s.centre.allFinite() && std::isfinite(s.radius) && s.radius > 0.f,
          "a sphere needs a finite centre and a radius above 0");
  }
  void operator()(const Cylinder& c) const {
    check(c.foot.allFinite() && c.axis.allFinite() && c.axis.norm() > 0.f && std::isfinite(c.radius) &&
              c.radius > 0.f,
          "a cylinder needs a finite place, a length above 0 and a radius above 0");
  }
};

}  // namespace

void checkShape(const Shape& shape) { std::visit(Checker{}, shape); }

RTCScene LinkScenes::of(const Link& link) {
  const auto same = [&](const Known& known) {
    return std::equal(link.parts.begin(), link.parts.end(), known.link->parts.begin(),
                      known.link->parts.end(), [](const Part& a, const Part& b) { return equal(a, b); });
  };
  const auto found = std::find_if(known_.begin(), known_.end(), same);
  if (found != known_.end()) return found->scene.get();
  SceneHandle scene(rtcNewScene(device_));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
  for (std::size_t i = 0; i < link.parts.size(); ++i) {
    checkShape(link.parts[i].shape);
    attach(device_, scene.get(), static_cast<unsigned>(i), link.parts[i]);
  }
  rtcCommitScene(scene.get());
  checkDevice(device_, "building the tree of a link");
  known_.push_back({&link, std::move(scene)});
  return known_.back().scene.get();
}

}  // namespace field_fusion::core::sim
