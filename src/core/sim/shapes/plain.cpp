// Solids of one material, walls, and what looks like them.
#include <stdexcept>

#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Model block(const ShapeParams& p, const Material& material) {
  const Vector3f half(0.5f * of(p, "length"), 0.5f * of(p, "width"), 0.f);
  return Builder().use(material).box(-half, half + Vector3f(0, 0, of(p, "height"))).build();
}

Model upright(const ShapeParams& p, const Material& material) {
  return Builder().use(material).rod({0, 0, 0}, {0, 0, of(p, "height")}, 0.5f * of(p, "diameter")).build();
}

Model ball(const ShapeParams& p, const Material& material) {
  const float radius = 0.5f * of(p, "diameter");
  return Builder().use(material).ball({0, 0, radius}, radius).build();
}

Material leather() {
  return patterned(glossy(kWhite, 0.6f, 0.15f), Material::Texture::kChecker, 0.07f, kBlack);
}

/// Boxes on each other, each turned a little against the one below.
Model stack(const ShapeParams& p) {
  Builder builder;
  const auto count = static_cast<int>(of(p, "count"));
  if (count < 1) throw std::invalid_argument("count must be at least 1");
  const float height = of(p, "height") / static_cast<float>(count);
  for (int i = 0; i < count; ++i) {
    const float shrink = 1.f - 0.15f * static_cast<float>(i % 3);
    const Vector3f half(0.5f * shrink * of(p, "length"), 0.5f * shrink * of(p, "width"), 0.f);
    const Vector3f foot(0.f, 0.f, height * static_cast<float>(i));
    builder.use(cardboard()).box(foot - half, foot + half + Vector3f(0, 0, height));
  }
  return builder.build();
}

}  // namespace

ShapeKinds plainShapes() {
  return {
      {"box",
       {"a box",
        {{"length", 1}, {"width", 1}, {"height", 1}},
        [](const ShapeParams& p) { return block(p, matt(kGrey, 0.5f)); }}},
      {"cylinder",
       {"an upright cylinder",
        {{"diameter", 0.5}, {"height", 1}},
        [](const ShapeParams& p) { return upright(p, matt(kGrey, 0.5f)); }}},
      {"cone",
       {"a cone",
        {{"diameter", 0.5}, {"height", 1}},
        [](const ShapeParams& p) {
          const auto mesh = lathe({{0.5f * of(p, "diameter"), 0.f}, {0.f, of(p, "height")}});
          return Builder().use(matt(kGrey, 0.5f)).mesh(mesh).build();
        }}},
      {"sphere",
       {"a sphere", {{"diameter", 1}}, [](const ShapeParams& p) { return ball(p, matt(kGrey, 0.5f)); }}},
      {"plane",
       {"a slab to lie on the ground",
        {{"length", 10}, {"width", 10}, {"height", 0.01}},
        [](const ShapeParams& p) { return block(p, concrete()); }}},
      {"wall",
       {"a plastered wall",
        {{"length", 4}, {"width", 0.15}, {"height", 2.6}},
        [](const ShapeParams& p) { return block(p, plaster()); }}},
      {"brick_wall",
       {"a wall of bricks",
        {{"length", 4}, {"width", 0.25}, {"height", 2.5}},
        [](const ShapeParams& p) { return block(p, bricks()); }}},
      {"cardboard_box",
       {"a cardboard box",
        {{"length", 0.4}, {"width", 0.3}, {"height", 0.3}},
        [](const ShapeParams& p) { return block(p, cardboard()); }}},
      {"stacked_boxes",
       {"cardboard boxes on each other",
        {{"length", 0.5}, {"width", 0.4}, {"height", 0.9}, {"count", 3}},
        stack}},
      {"tube",
       {"a cardboard tube, standing",
        {{"diameter", 0.2}, {"height", 0.6}},
        [](const ShapeParams& p) { return upright(p, cardboard()); }}},
      {"football",
       {"a football", {{"diameter", 0.22}}, [](const ShapeParams& p) { return ball(p, leather()); }}},
      {"balloon",
       {"a big rubber ball",
        {{"diameter", 0.5}},
        [](const ShapeParams& p) { return ball(p, glossy(kRed, 0.5f, 0.3f)); }}},
      {"pole",
       {"a steel pole",
        {{"diameter", 0.12}, {"height", 5}},
        [](const ShapeParams& p) { return upright(p, steel()); }}},
      {"container",
       {"a freight container",
        {{"length", 6.06}, {"width", 2.44}, {"height", 2.59}},
        [](const ShapeParams& p) {
          return block(p, patterned(paint(kBlue), Material::Texture::kStripes, 0.28f, 0.8f * kBlue));
        }}},
  };
}

}  // namespace field_fusion::core::sim
