#include "builder.h"

#include <cmath>

namespace field_fusion::core::sim {
namespace {

constexpr std::uint32_t kSegments =
    32;  // of a turned body: the facets leave the circle by 0.5 % of its radius

std::vector<Vector3f> rectangle(const Eigen::Vector4f& r, float z) {
  return {{r[0], r[2], z}, {r[1], r[2], z}, {r[1], r[3], z}, {r[0], r[3], z}};
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto& v = mesh.vertices;
  if ((v[b] - v[a]).cross(v[c] - v[a]).squaredNorm() > 0.f) mesh.triangles.push_back({a, b, c});
}

/// `first` is the place of the ring's first point of `count`.
void closeEnd(Mesh& mesh, std::uint32_t first, std::uint32_t count, bool top) {
  Vector3f middle = Vector3f::Zero();
  for (std::uint32_t i = 0; i < count; ++i) middle += mesh.vertices[first + i] / static_cast<float>(count);
  const auto centre = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(middle);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = first + i, b = first + (i + 1) % count;
    top ? addTriangle(mesh, centre, a, b) : addTriangle(mesh, centre, b, a);
  }
}

}  // namespace

Mesh loft(const std::vector<std::vector<Vector3f>>& rings, bool closed_ends) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(rings.front().size());
  for (const auto& ring : rings) mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = r * count + i, b = r * count + (i + 1) % count;
      addTriangle(mesh, a, b, b + count), addTriangle(mesh, a, b + count, a + count);
    }
  if (!closed_ends) return mesh;
  closeEnd(mesh, 0, count, false);
  closeEnd(mesh, count * static_cast<std::uint32_t>(rings.size() - 1), count, true);
  return mesh;
}

Mesh frustum(const Eigen::Vector4f& below, float z_below, const Eigen::Vector4f& above, float z_above) {
  return loft({rectangle(below, z_below), rectangle(above, z_above)});
}

Mesh boxMesh(const Vector3f& low, const Vector3f& high) {
  const Eigen::Vector4f flat(low.x(), high.x(), low.y(), high.y());
  return frustum(flat, low.z(), flat, high.z());
}

Mesh lathe(const std::vector<Vector2f>& profile, bool closed_ends) {
  std::vector<std::vector<Vector3f>> rings;
  for (const Vector2f& p : profile) {
    auto& ring = rings.emplace_back();
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const double angle = radians(360.0) * i / kSegments;
      ring.emplace_back(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
    }
  }
  return loft(rings, closed_ends);
}

Mesh torus(float outer, float tube, float z) {
  constexpr int kAround = 16;
  std::vector<Vector2f> profile;
  for (int i = 0; i <= kAround; ++i) {  // up along the outside, back along the inside
    const double angle = radians(360.0) * (i % kAround) / kAround;
    profile.emplace_back(outer - tube + tube * std::cos(angle), z + tube * std::sin(angle));
  }
  return lathe(profile, false);
}

Builder& Builder::use(const Material& material, const char* role) {
  material_ = material, role_ = role, fresh_ = true;
  return *this;
}

Builder& Builder::mesh(const Mesh& mesh) {
  if (fresh_ || parts().empty() || !std::holds_alternative<Mesh>(parts().back().shape))
    parts().push_back({Mesh{}, material_, role_});
  std::get<Mesh>(parts().back().shape).add(mesh);
  fresh_ = false;
  return *this;
}

Builder& Builder::rod(const Vector3f& from, const Vector3f& to, float radius) {
  parts().push_back({Cylinder{from, to - from, radius}, material_, role_});
  return *this;
}

Builder& Builder::ball(const Vector3f& centre, float radius) {
  parts().push_back({Sphere{centre, radius}, material_, role_});
  return *this;
}

Builder& Builder::fourLegs(float x, float y, float thick, float height) {
  for (const float sx : {-x, x - thick})
    for (const float sy : {-y, y - thick}) box({sx, sy, 0.f}, {sx + thick, sy + thick, height});
  return *this;
}

int Builder::link(const Joint& joint, int parent) {
  model_.links.push_back({{}, joint, parent});
  fresh_ = true;
  return static_cast<int>(model_.links.size()) - 1;
}

}  // namespace field_fusion::core::sim
