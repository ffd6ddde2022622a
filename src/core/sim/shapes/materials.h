#pragma once
// What the bodies of the library are made of: colours as seen, reflectivities as surveys of common surfaces
// at 905 nm give them (rounded; a world file may change any).
#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

inline Material matt(const Eigen::Vector3f& colour, float reflectivity) {
  Material m;
  m.colour = colour, m.colour2 = 0.8f * colour, m.reflectivity = reflectivity;
  return m;
}

inline Material glossy(const Eigen::Vector3f& colour, float reflectivity, float gloss) {
  Material m = matt(colour, reflectivity);
  m.gloss = gloss;
  return m;
}

inline Material patterned(Material m, Material::Texture texture, float size, const Eigen::Vector3f& colour2) {
  m.texture = texture, m.texture_size = size, m.colour2 = colour2;
  return m;
}

inline Material sheer(Material m, float transparency) {
  m.transparency = transparency;
  return m;
}

inline Material rubber() { return matt({0.03f, 0.03f, 0.03f}, 0.06f); }
inline Material steel() { return glossy({0.45f, 0.46f, 0.48f}, 0.4f, 0.3f); }
inline Material glass() { return sheer(glossy({0.1f, 0.13f, 0.15f}, 0.1f, 0.8f), 0.5f); }
inline Material cardboard() {
  return patterned(matt({0.5f, 0.34f, 0.19f}, 0.6f), Material::Texture::kNoise, 0.15f, {0.44f, 0.29f, 0.16f});
}
inline Material wood() {
  return patterned(matt({0.45f, 0.28f, 0.14f}, 0.5f), Material::Texture::kStripes, 0.06f,
                   {0.36f, 0.21f, 0.1f});
}
inline Material concrete() {
  return patterned(matt({0.42f, 0.41f, 0.39f}, 0.35f), Material::Texture::kNoise, 0.4f,
                   {0.34f, 0.33f, 0.31f});
}
inline Material bricks() {
  return patterned(matt({0.42f, 0.16f, 0.1f}, 0.4f), Material::Texture::kBricks, 0.24f, {0.5f, 0.48f, 0.44f});
}
inline Material plaster() {
  return patterned(matt({0.72f, 0.71f, 0.67f}, 0.75f), Material::Texture::kNoise, 0.6f,
                   {0.68f, 0.67f, 0.63f});
}
inline Material leaves() {
  return patterned(matt({0.07f, 0.19f, 0.04f}, 0.55f), Material::Texture::kNoise, 0.25f,
                   {0.03f, 0.1f, 0.02f});
}
inline Material bark() {
  return patterned(matt({0.16f, 0.1f, 0.06f}, 0.35f), Material::Texture::kNoise, 0.08f, {0.1f, 0.06f, 0.03f});
}
inline Material skin() { return matt({0.55f, 0.34f, 0.24f}, 0.55f); }
inline Material plastic(const Eigen::Vector3f& colour) { return glossy(colour, 0.45f, 0.1f); }
inline Material paint(const Eigen::Vector3f& colour) { return glossy(colour, 0.5f, 0.35f); }
inline Material cloth(const Eigen::Vector3f& colour) {
  return patterned(matt(colour, 0.45f), Material::Texture::kNoise, 0.1f, 0.75f * colour);
}

inline const Eigen::Vector3f kWhite{0.8f, 0.8f, 0.8f}, kBlack{0.02f, 0.02f, 0.02f}, kRed{0.6f, 0.04f, 0.03f},
    kBlue{0.03f, 0.12f, 0.55f}, kOrange{0.75f, 0.2f, 0.02f}, kYellow{0.75f, 0.55f, 0.04f},
    kGreen{0.05f, 0.3f, 0.09f}, kGrey{0.3f, 0.3f, 0.31f};

}  // namespace field_fusion::core::sim
