#pragma once
// What a body of a world is made of. Body frame: x forward, y left, z up, the origin on the ground below it.
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core::sim {

/// Triangles; counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;                ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< places in vertices

  void add(const Mesh& other, const Eigen::Isometry3f& T_this_other = Eigen::Isometry3f::Identity());
};

/// Analytic, so that a range to it has no facets.
struct Sphere {
  Eigen::Vector3f centre;  ///< [m]
  float radius;            ///< [m]
};

/// Analytic, closed at both ends.
struct Cylinder {
  Eigen::Vector3f foot;  ///< [m] middle of one end
  Eigen::Vector3f axis;  ///< [m] from there to the middle of the other end
  float radius;          ///< [m]
};

/// T_link_cylinder of a cylinder about z in the middle of its own frame, as URDF and RViz have them.
Transform frameOf(const Cylinder& cylinder);

/// How a surface answers to light. Textures are solid: they depend on the place in the body's frame.
struct Material {
  enum class Texture {
    kPlain,
    kNoise,
    kChecker,
    kStripes,
    kBricks,
    kBlotches,  ///< noise with sharp edges
    kDots,
    kGrid,    ///< thin lines along all three axes
    kSlants,  ///< stripes that rise at a slant
    kPlanks,  ///< upright, each of its own shade
    kWedges   ///< about the z axis, as of a beach ball; of no size
  };

  Eigen::Vector3f colour{0.5f, 0.5f, 0.5f};   ///< 0..1, linear RGB, diffuse
  Eigen::Vector3f colour2{0.4f, 0.4f, 0.4f};  ///< the texture's other colour
  Texture texture = Texture::kPlain;
  float texture_size = 0.2f;  ///< [m] of its pattern
  float wear = 0.f;           ///< 0..1, how dark the dirt in patches is
  float reflectivity = 0.5f;  ///< 0..1, diffuse, at a LiDAR's 905 nm
  float gloss = 0.f;  ///< 0..1, share of light that it mirrors: lost to a LiDAR, a highlight to a camera
  float transparency = 0.f;  ///< 0..1, share of rays that pass: nets, glass
};

/// Red, green, blue and alpha, 0..1, as screens take them, by a power law; of a texture the mean.
Eigen::Vector4f shownColour(const Material& material);

using Shape = std::variant<Mesh, Sphere, Cylinder>;

struct Part {
  Shape shape;
  Material material;
  std::string role{};  ///< what it is in its body, such as "hull": a world can paint it by that name
};

/// Swings about an axis: angle(t) = bias + amplitude sin(2 pi t / period + phase).
struct Joint {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< unit vector
  double amplitude = 0.0;                           ///< [rad]
  double period = 1.0;                              ///< [s]
  double phase = 0.0;                               ///< [rad]
  double bias = 0.0;                                ///< [rad]

  Transform at(double time) const;  ///< T_parent_link
};

struct Link {
  std::vector<Part> parts;
  std::optional<Joint> joint;  ///< none: stands fast on what carries it
  int parent = -1;             ///< the link before this one that carries it, as a thigh a shin; -1: the body
};

struct Model {
  std::vector<Link> links;

  Transform linkPose(std::size_t link, double time) const;  ///< T_body_link
  /// All joints at their bias. Empty for a model of no parts.
  Eigen::AlignedBox3d box() const;
};

}  // namespace field_fusion::core::sim
