// Fish cages. z = 0 is the water; the net reaches the draught below it.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Vector3f onCircle(float radius, int i, int count, float z) {
  const double angle = radians(360.0) * i / count;
  return {radius * static_cast<float>(std::cos(angle)), radius * static_cast<float>(std::sin(angle)), z};
}

Material netOf(const ShapeParams& p) { return sheer(matt(kGreen, 0.25f), of(p, "transparency")); }

/// Handrails between the water and the top, the lowest of them at half the height.
template <class Rail>
void rails(int count, float top, Rail&& rail) {
  for (int i = 0; i < count; ++i)
    rail(top * (count == 1 ? 1.f : 0.5f + 0.5f * static_cast<float>(i) / static_cast<float>(count - 1)));
}

/// A gravity cage of marine ranching, as in the USV paper: two floating rings of pipe, stanchions with
/// handrails, and a net from there into the depth.
Model cage(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), tube = 0.5f * of(p, "tube");
  const float rail = std::min(0.4f * tube, 0.1f * h), middle = r - tube, inner = r - 3.2f * tube;
  const int posts = std::max(3, static_cast<int>(of(p, "posts")));
  Builder builder;
  builder.use(plastic(kBlack), "float").mesh(torus(r, tube, 0.f)).mesh(torus(inner + tube, tube, 0.f));
  builder.use(plastic(kOrange), "rail");
  rails(static_cast<int>(of(p, "rails")), h - rail,
        [&](float z) { builder.mesh(torus(inner + rail, rail, z)); });
  for (int i = 0; i < posts; ++i) {
    builder.rod(onCircle(inner, i, posts, 0.f), onCircle(inner, i, posts, h - rail), rail);
    if (of(p, "unbraced") == 0.f)
      builder.rod(onCircle(middle, i, posts, 0.f), onCircle(inner, i, posts, 0.5f * h), rail);
  }
  const float hang = inner - rail, deep = -of(p, "draught");
  builder.use(netOf(p), "net");
  builder.mesh(lathe({{0.02f * hang, deep}, {0.9f * hang, deep}, {hang, 0}, {hang, h - rail}}, false));
  return builder.build();
}

/// The same with a net against birds: spokes from the handrail up to the head of a pole on a float.
Model birdNetCage(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), tube = 0.5f * of(p, "tube");
  const float edge = 0.45f * h, rope = 0.15f * tube, inner = r - 2.4f * tube, deep = -of(p, "draught");
  const int posts = std::max(3, static_cast<int>(of(p, "posts")));
  Builder builder;
  builder.use(plastic(kBlack), "float").mesh(torus(r, tube, 0.f)).mesh(torus(inner + tube, tube, 0.f));
  builder.use(steel(), "rail").mesh(torus(inner + 0.4f * tube, 0.4f * tube, edge));
  for (int i = 0; i < posts; ++i) {
    builder.box(onCircle(inner, i, posts, 0.f) - Vector3f(0.5f * tube, 0.5f * tube, 0.f),
                onCircle(inner, i, posts, edge) + Vector3f(0.5f * tube, 0.5f * tube, 0.f));
    builder.rod(onCircle(inner, i, posts, edge), {0, 0, h - rope}, rope);
  }
  builder.rod({0, 0, 0}, {0, 0, h}, 0.4f * tube);
  builder.use(plastic(kYellow), "pole_float").rod({0, 0, -0.5f * tube}, {0, 0, tube}, 3.f * tube);
  builder.use(netOf(p), "net");
  builder.mesh(lathe({{0.02f * inner, deep}, {0.9f * inner, deep}, {inner, 0}, {inner, edge}}, false));
  return builder.build();
}

/// One side of a square along x at -y, of what is `wide`; turned for the other three.
template <class Side>
void fourSides(Side&& side) {
  for (int i = 0; i < 4; ++i) {
    const float c = i % 2 == 0 ? 1.f - static_cast<float>(i) : 0.f,
                s = i % 2 == 1 ? 2.f - static_cast<float>(i) : 0.f;
    side([c, s](float x, float y, float z) { return Vector3f(c * x - s * y, s * x + c * y, z); });
  }
}

/// Between two corners in any order.
void slab(Builder& builder, const Vector3f& a, const Vector3f& b) {
  builder.box(a.cwiseMin(b), a.cwiseMax(b));
}

/// Square, of gangways on floats, with handrails on their inner side; `drums` of them on a side, or beams.
Model pontoonCage(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), deep = -of(p, "draught");
  const float wide = std::min(of(p, "gangway"), 0.4f * r), deck = 0.3f * h, rail = 0.02f * h + 0.008f;
  const float inner = r - wide, thick = 0.08f * h, under = std::max(deep, -0.2f);
  const int posts = std::max(2, static_cast<int>(of(p, "posts"))), drums = static_cast<int>(of(p, "drums"));
  Builder builder;
  fourSides([&](auto at) {
    builder.use(wood(), "deck");
    slab(builder, at(-r, -r, deck - thick), at(inner, -inner, deck));
    builder.use(plastic(kBlue), "float");
    for (int i = 0; i < drums; ++i) {
      const float x = -r + 2.f * r * (static_cast<float>(i) + 0.5f) / static_cast<float>(drums),
                  half = 0.35f * wide;
      slab(builder, at(x - half, -r + 0.1f * wide, under), at(x + half, -inner - 0.1f * wide, deck - thick));
    }
    if (drums == 0)
      slab(builder, at(-r, -r + 0.1f * wide, under), at(inner, -inner - 0.1f * wide, deck - thick));
    builder.use(steel(), "rail");
    const float line = inner + rail;
    for (int i = 0; i < posts; ++i) {
      const float x = -line + 2.f * line * static_cast<float>(i) / static_cast<float>(posts);
      builder.rod(at(x, -line, deck), at(x, -line, h - rail), rail);
    }
    for (const float share : {0.5f, 1.f}) {
      const float z = deck + share * (h - rail - deck);
      builder.rod(at(-line, -line, z), at(line, -line, z), rail);
    }
  });
  builder.use(netOf(p), "net");
  const auto ring = [](float a, float z) {
    return std::vector<Vector3f>{{-a, -a, z}, {a, -a, z}, {a, a, z}, {-a, a, z}};
  };
  builder.mesh(loft(
      {ring(0.02f * inner, deep), ring(0.9f * inner, deep), ring(inner, 0), ring(inner, h - rail)}, false));
  return builder.build();
}

}  // namespace

ShapeKinds cageShapes() {
  const ShapeParams ring = {{"diameter", 2}, {"height", 1},   {"tube", 0.2},  {"posts", 12},
                            {"rails", 2},    {"unbraced", 0}, {"draught", 2}, {"transparency", 0.75}};
  return {
      {"cage", {"a round fish cage of marine ranching; `unbraced` 1: posts alone", ring, cage}},
      {"bird_net_cage",
       {"a round fish cage under a net against birds",
        {{"diameter", 6},
         {"height", 2},
         {"tube", 0.3},
         {"posts", 16},
         {"draught", 2},
         {"transparency", 0.75}},
        birdNetCage}},
      {"pontoon_cage",
       {"a square fish cage of gangways on floats; `drums` 0: on beams",
        {{"diameter", 5},
         {"height", 1.3},
         {"gangway", 0.6},
         {"posts", 6},
         {"drums", 0},
         {"draught", 2},
         {"transparency", 0.75}},
        pontoonCage}},
  };
}

}  // namespace field_fusion::core::sim
