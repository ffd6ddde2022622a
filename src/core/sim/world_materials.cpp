#include <set>

#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

std::vector<Part*> everyPart(Model& model) {
  std::vector<Part*> out;
  for (Link& link : model.links)
    for (Part& part : link.parts) out.push_back(&part);
  return out;
}

/// By what the parts are.
void readMaterials(const Yaml& yaml, Model& model) {
  std::set<std::string> roles;
  std::string names;
  for (const Part* part : everyPart(model))
    if (!part->role.empty() && roles.insert(part->role).second) names += " " + part->role;
  for (const std::string& role : yaml.keys()) {
    if (!roles.count(role))
      yaml[role].fail("no part is that; there are:" + (names.empty() ? " none" : names));
    for (Part* part : everyPart(model))
      if (part->role == role) readMaterial(yaml[role], part->material);
  }
}

}  // namespace

void readMaterial(const Yaml& yaml, Material& material) {
  yaml.onlyKeys(
      {"colour", "colour2", "texture", "texture_size", "reflectivity", "gloss", "wear", "transparency"});
  const auto colour = [&yaml](const char* key, Eigen::Vector3f& out) {
    if (!yaml.has(key)) return;
    const auto items = yaml[key].list();
    if (items.size() != 3) yaml[key].fail("must be [red, green, blue]");
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(items[static_cast<std::size_t>(i)].number(0, 1));
  };
  const auto share = [&yaml](const char* key, float& out) {
    if (yaml.has(key)) out = static_cast<float>(yaml[key].number(0, 1));
  };
  colour("colour", material.colour);
  colour("colour2", material.colour2);
  if (yaml.has("texture"))
    material.texture = static_cast<Material::Texture>(
        yaml["texture"].oneOf({"plain", "noise", "checker", "stripes", "bricks", "blotches", "dots", "grid",
                               "slants", "planks", "wedges"}));
  if (yaml.has("texture_size")) material.texture_size = static_cast<float>(yaml["texture_size"].positive());
  share("reflectivity", material.reflectivity);
  share("gloss", material.gloss);
  share("wear", material.wear);
  share("transparency", material.transparency);
}

void paint(const Yaml& yaml, Model& model) {
  if (yaml.has("material"))
    for (Part* part : everyPart(model)) readMaterial(yaml["material"], part->material);
  if (yaml.has("materials")) readMaterials(yaml["materials"], model);
}

}  // namespace field_fusion::core::sim
