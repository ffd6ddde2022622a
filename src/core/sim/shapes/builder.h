#pragma once
// Puts models together from solids.
#include <vector>

#include "field_fusion/core/sim/shapes.h"

namespace field_fusion::core::sim {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Triangles around a stack of rings of equally many points, the ends closed by fans. Rings run
/// counter-clockwise seen from where the stack goes to.
Mesh loft(const std::vector<std::vector<Vector3f>>& rings, bool closed_ends = true);
Mesh boxMesh(const Vector3f& low, const Vector3f& high);
/// Between a rectangle at z = low.z and one at z = high.z, each {x from, x to, y from, y to}.
Mesh frustum(const Eigen::Vector4f& below, float z_below, const Eigen::Vector4f& above, float z_above);
/// Radius and height of each ring, upwards.
Mesh lathe(const std::vector<Vector2f>& profile, bool closed_ends = true);
/// Lies flat about the z axis, reaching `outer` [m] from it; `tube` is the radius of what is bent.
Mesh torus(float outer, float tube, float z);

class Builder {
 public:
  /// Of all that follows, and what that is in the body.
  Builder& use(const Material& material, const char* role = "");
  Builder& mesh(const Mesh& mesh);  ///< meshes of one material that follow each other become one part
  Builder& box(const Vector3f& low, const Vector3f& high) { return mesh(boxMesh(low, high)); }
  Builder& rod(const Vector3f& from, const Vector3f& to, float radius);
  Builder& ball(const Vector3f& centre, float radius);
  /// A box, its rectangle mirrored to all four quarters: legs.
  Builder& fourLegs(float x, float y, float thick, float height);

  /// All that follows swings about the joint, which hangs on an earlier link (-1: on the body).
  int link(const Joint& joint, int parent = -1);
  Model build() { return std::move(model_); }

 private:
  std::vector<Part>& parts() { return model_.links.back().parts; }

  Model model_{{Link{}}};
  Material material_;
  const char* role_ = "";
  bool fresh_ = true;  // the next mesh begins a part
};

inline float of(const ShapeParams& params, const char* name) { return static_cast<float>(params.at(name)); }

/// Of a body that stands about the z axis.
struct Extent {
  float x, y, h;  ///< [m] half the length, half the width, all of the height

  explicit Extent(const ShapeParams& p)
      : x(0.5f * of(p, "length")), y(0.5f * of(p, "width")), h(of(p, "height")) {}
};

}  // namespace field_fusion::core::sim
