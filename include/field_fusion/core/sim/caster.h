#pragma once
// Casts rays into a world; every sensor sees the same world through it.
#include <memory>

#include "field_fusion/core/sim/world.h"

namespace field_fusion::core::sim {

struct Ray {
  Eigen::Vector3f origin;     ///< [m] world
  Eigen::Vector3f direction;  ///< unit vector
  float time = 0.f;           ///< 0..1 within the caster's window; other rays hit nothing
};

struct Hit {
  static constexpr int kNothing = -1, kGround = -2, kRobot = -3;

  float range = std::numeric_limits<float>::infinity();  ///< [m] along the ray
  int body = kNothing;                                   ///< place in World::bodies
  Eigen::Vector3f normal{0, 0, 1};                       ///< unit vector, world, towards the ray's origin
  Eigen::Vector3f place{0, 0, 0};      ///< [m] in the frame of the link that was hit, for textures
  const Material* material = nullptr;  ///< of what was hit; null for nothing
};

/// Intel Embree holds the world and finds the first surface; the range to it is then computed in double
/// precision, so that it is exact to 1e-6 of itself wherever in the world the ray starts. Surfaces have two
/// sides.
///
/// Each surface with a transparency lets a ray pass by chance, drawn from the bits of the ray's origin and
/// direction and from the surface: a ray cast twice meets the same fate, a ray beside it may not.
///
/// Casting is thread-safe; setWindow is not.
class Caster {
 public:
  /// The world must outlive the caster and not change. Throws std::invalid_argument naming the body for a
  /// mesh without triangles and for sizes that are not above 0.
  explicit Caster(const World& world);
  ~Caster();

  /// The span of time [s] in which the next rays are cast. Bodies move in it along straight lines between
  /// instants 10 ms apart, at most 128, so a window is a scan or a frame, not an hour. Throws
  /// std::invalid_argument for a window that ends before it begins.
  void setWindow(double begin, double end);

  Hit cast(const Ray& ray) const;
  /// Rays next to each other in the array should be next to each other in the world: eight go together.
  /// Plane and water are not there without `ground`.
  void cast(const Ray* rays, Hit* hits, std::size_t count, bool ground = true) const;
  /// Whether something stands between the origin and `distance` [m] along the ray.
  bool blocked(const Ray& ray, float distance) const;
  /// The same for many rays, eight at a time.
  void blocked(const Ray* rays, float distance, bool* results, std::size_t count, bool ground = true) const;
  /// [m] to a body, or Hit::kRobot, as if it were alone in the world; infinite: missed.
  float rangeTo(int body, const Ray& ray) const;
  /// The same for many rays, eight at a time.
  void rangesTo(int body, const Ray* rays, float* ranges, std::size_t count) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace field_fusion::core::sim
