// Stools.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// Round, three legs or more that may be splayed, a ring to put the feet on.
Model stool(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), leg = 0.08f * r, seat = 0.08f * h;
  const int legs = std::max(3, static_cast<int>(of(p, "legs")));
  const float foot = 0.85f * r, head = foot * (1.f - std::min(0.7f, of(p, "splay")));
  Builder builder;
  builder.use(wood(), "seat").rod({0, 0, h - seat}, {0, 0, h}, r);
  builder.use(steel(), "leg");
  for (int i = 0; i < legs; ++i) {
    const double angle = radians(360.0) * i / legs;
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    builder.rod({foot * c, foot * s, 0}, {head * c, head * s, h - seat}, leg);
  }
  return builder.mesh(torus(foot + 0.3f * (head - foot) + leg, leg, 0.3f * h)).build();
}

/// A column on a plate, and a padded seat.
Model barStool(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), column = 0.12f * r;
  Builder builder;
  builder.use(steel(), "leg")
      .mesh(lathe({{r, 0}, {r, 0.02f * h}, {0.3f * r, 0.04f * h}, {column, 0.08f * h}, {column, 0.85f * h}}));
  builder.mesh(torus(0.65f * r, 0.06f * r, 0.35f * h))
      .rod({-0.6f * r, 0, 0.35f * h}, {0.6f * r, 0, 0.35f * h}, 0.06f * r);
  builder.use(plastic(kRed), "seat")
      .mesh(lathe({{0.6f * r, 0.85f * h}, {0.9f * r, 0.88f * h}, {0.95f * r, 0.97f * h}, {0.8f * r, h}}));
  return builder.build();
}

Model squareStool(const ShapeParams& p) {
  const Extent e(p);
  const float leg = 0.13f * std::min(e.x, e.y), top = 0.1f * e.h;
  Builder builder;
  builder.use(wood(), "seat").box({-e.x, -e.y, e.h - top}, {e.x, e.y, e.h});
  builder.use(wood(), "leg").fourLegs(0.97f * e.x, 0.97f * e.y, leg, e.h - top);
  for (const float x : {-0.95f * e.x, 0.95f * e.x - 0.7f * leg})
    builder.box({x, -0.9f * e.y, 0.3f * e.h}, {x + 0.7f * leg, 0.9f * e.y, 0.36f * e.h});
  return builder.build();
}

/// Crossed legs and a seat of cloth.
Model foldingStool(const ShapeParams& p) {
  const Extent e(p);
  const float bar = 0.07f * e.x, in = e.x - bar;
  Builder builder;
  builder.use(wood(), "leg");
  for (const float y : {-e.y + bar, e.y - bar})
    builder.rod({-in, y, bar}, {in, y, e.h - bar}, bar).rod({in, y, bar}, {-in, y, e.h - bar}, bar);
  for (const float x : {-in, in}) builder.box({x - bar, -e.y, 0}, {x + bar, e.y, 2 * bar});
  builder.use(cloth(kBlue), "seat").box({-e.x, -0.95f * e.y, 0.94f * e.h}, {e.x, 0.95f * e.y, e.h});
  return builder.build();
}

/// Two upright boards under a third.
Model boardStool(const ShapeParams& p) {
  const Extent e(p);
  const float board = 0.12f * e.y;
  Builder builder;
  builder.use(wood(), "seat").box({-e.x, -e.y, e.h - board}, {e.x, e.y, e.h});
  builder.use(wood(), "leg");
  for (const float y : {-0.8f * e.y, 0.8f * e.y - board})
    builder.mesh(frustum({-0.95f * e.x, 0.95f * e.x, y, y + board}, 0,
                         {-0.75f * e.x, 0.75f * e.x, y, y + board}, e.h - board));
  return builder.box({-0.1f * e.x, -0.75f * e.y, 0.4f * e.h}, {0.1f * e.x, 0.75f * e.y, 0.6f * e.h}).build();
}

}  // namespace

ShapeKinds stoolShapes() {
  const ShapeParams stools = {{"length", 0.35}, {"width", 0.35}, {"height", 0.45}};
  return {
      {"stool",
       {"a round stool; `splay` of the legs 0..0.7",
        {{"diameter", 0.35}, {"height", 0.45}, {"legs", 3}, {"splay", 0}},
        stool}},
      {"bar_stool", {"a stool on a column", {{"diameter", 0.42}, {"height", 0.75}}, barStool}},
      {"square_stool", {"a stool on four legs", stools, squareStool}},
      {"folding_stool",
       {"a stool of crossed legs", {{"length", 0.4}, {"width", 0.35}, {"height", 0.45}}, foldingStool}},
      {"board_stool", {"a stool of three boards", stools, boardStool}},
  };
}

}  // namespace field_fusion::core::sim
