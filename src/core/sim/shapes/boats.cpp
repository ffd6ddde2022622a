// Boats. z = 0 is the water; x is ahead.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// A hull's sizes: half, half, and heights over the water.
struct Size {
  float x, y, h, keel;

  explicit Size(const ShapeParams& p)
      : x(0.5f * of(p, "length")), y(0.5f * of(p, "width")), h(of(p, "height")), keel(-of(p, "draught")) {}
};

/// Counter-clockwise seen from ahead.
std::vector<Vector3f> station(float at, float wide, float bottom, float top) {
  return {{at, -wide, top},
          {at, -0.8f * wide, 0.5f * bottom},
          {at, 0, bottom},
          {at, 0.8f * wide, 0.5f * bottom},
          {at, wide, top}};
}

/// A pointed bow and a flat stern; the deck is `deck` high amidships and higher by `sheer` of it at the bow.
Mesh hull(const Size& s, float deck, float sheer, float stern = 0.85f) {
  return loft({station(-s.x, stern * s.y, 0.8f * s.keel, deck), station(-0.3f * s.x, s.y, s.keel, deck),
               station(0.3f * s.x, 0.95f * s.y, s.keel, (1 + 0.2f * sheer) * deck),
               station(0.75f * s.x, 0.5f * s.y, 0.7f * s.keel, (1 + 0.6f * sheer) * deck),
               station(s.x, 0.02f * s.y, 0.2f * deck, (1 + sheer) * deck)});
}

/// Walls, windows all around and a roof.
void house(Builder& builder, const Eigen::Vector4f& foot, float from, const Eigen::Vector4f& head, float to) {
  const auto level = [&](float share) { return Eigen::Vector4f(foot + share * (head - foot)); };
  const auto z = [&](float share) { return from + share * (to - from); };
  Material window = glass();
  window.transparency = 0.f;
  builder.use(paint(kBlue), "cabin").mesh(frustum(level(0.f), z(0.f), level(0.5f), z(0.5f)));
  builder.mesh(frustum(level(0.85f), z(0.85f), head, to));
  builder.use(window, "window").mesh(frustum(level(0.5f), z(0.5f), level(0.85f), z(0.85f)));
}

/// A cabin and a mast. `cabin` is how far its middle stands ahead of the stern, 0..1 of the length.
Model boat(const ShapeParams& p) {
  const Size s(p);
  const float deck = 0.35f * s.h, at = -s.x + 2.f * s.x * std::clamp(of(p, "cabin"), 0.2f, 0.7f);
  Builder builder;
  builder.use(paint(kWhite), "hull").mesh(hull(s, deck, 0.25f));
  house(builder, {at - 0.35f * s.x, at + 0.35f * s.x, -0.6f * s.y, 0.6f * s.y}, 0.9f * deck,
        {at - 0.3f * s.x, at + 0.15f * s.x, -0.5f * s.y, 0.5f * s.y}, 0.75f * s.h);
  builder.use(steel(), "mast").rod({at - 0.05f * s.x, 0, 0.75f * s.h}, {at - 0.05f * s.x, 0, s.h}, 0.03f);
  builder.use(rubber(), "fender");
  for (const float side : {-0.9f * s.y, 0.9f * s.y})
    for (const float x : {-0.5f * s.x, 0.f})
      builder.rod({x, side, 0.25f * deck}, {x, side, 0.9f * deck}, 0.05f * s.y);
  return builder.build();
}

/// A wheelhouse behind, a derrick and a gallows: a small trawler.
Model fishingBoat(const ShapeParams& p) {
  const Size s(p);
  const float deck = 0.25f * s.h, roof = 0.62f * s.h, pole = 0.012f * s.h + 0.02f;
  Builder builder;
  builder.use(paint(kBlue), "hull").mesh(hull(s, deck, 0.5f, 0.75f));
  house(builder, {-0.6f * s.x, -0.1f * s.x, -0.55f * s.y, 0.55f * s.y}, 0.9f * deck,
        {-0.6f * s.x, -0.12f * s.x, -0.55f * s.y, 0.55f * s.y}, roof);
  builder.use(steel(), "mast").rod({0.1f * s.x, 0, 0.9f * deck}, {0.1f * s.x, 0, s.h}, pole);
  builder.rod({0.1f * s.x, 0, 0.5f * s.h}, {-0.5f * s.x, 0, 0.95f * s.h}, 0.7f * pole);
  for (const float side : {-0.6f * s.y, 0.6f * s.y})
    builder.rod({-0.85f * s.x, side, 0.8f * deck}, {-0.85f * s.x, side, 0.6f * s.h}, pole);
  builder.rod({-0.85f * s.x, -0.6f * s.y, 0.6f * s.h}, {-0.85f * s.x, 0.6f * s.y, 0.6f * s.h}, pole);
  builder.use(cardboard(), "gear")
      .box({0.25f * s.x, -0.4f * s.y, deck}, {0.5f * s.x, 0.4f * s.y, 1.5f * deck});
  return builder.build();
}

/// Open, with thwarts; its inside is drawn as a dark floor a little below the rim.
Model rowingBoat(const ShapeParams& p) {
  const Size s(p);
  Builder builder;
  builder.use(wood(), "hull").mesh(hull(s, 0.75f * s.h, 0.333f, 0.7f));
  const float rim = 0.76f * s.h;
  builder.use(matt(kGrey, 0.3f), "floor")
      .mesh(frustum({-0.92f * s.x, 0.2f * s.x, -0.65f * s.y, 0.65f * s.y}, 0.7f * s.h,
                    {-0.92f * s.x, 0.2f * s.x, -0.65f * s.y, 0.65f * s.y}, rim));
  builder.use(wood(), "thwart");
  for (const float x : {-0.7f * s.x, -0.2f * s.x, 0.3f * s.x})
    builder.box({x, -0.75f * s.y, 0.74f * s.h}, {x + 0.12f * s.x, 0.75f * s.y, 0.82f * s.h});
  return builder.build();
}

/// A long hull, a mast, a boom and a sail that is set or, with `sail` 0, furled on the boom.
Model sailingBoat(const ShapeParams& p) {
  const Size s(p);
  const float deck = 0.11f * s.h, boom = 0.22f * s.h, mast = 0.1f * s.x, pole = 0.006f * s.h + 0.02f;
  Builder builder;
  builder.use(paint(kWhite), "hull").mesh(hull(s, deck, 0.2f, 0.6f));
  house(builder, {-0.3f * s.x, 0.35f * s.x, -0.45f * s.y, 0.45f * s.y}, 0.9f * deck,
        {-0.25f * s.x, 0.2f * s.x, -0.35f * s.y, 0.35f * s.y}, 1.6f * deck);
  builder.use(steel(), "mast").rod({mast, 0, deck}, {mast, 0, s.h}, pole);
  builder.rod({mast, 0, boom}, {-0.8f * s.x, 0, boom}, pole);
  builder.rod({0.97f * s.x, 0, 1.15f * deck}, {mast, 0, 0.95f * s.h}, 0.3f * pole);
  builder.use(cloth(kWhite), "sail");
  if (of(p, "sail") > 0.f) {
    const float thick = 0.01f;
    const auto edge = [&](float y) {
      return std::vector<Vector3f>{
          {mast, y, boom + 0.1f}, {-0.78f * s.x, y, boom + 0.1f}, {mast - 0.05f * s.x, y, 0.93f * s.h}};
    };
    builder.mesh(loft({edge(thick), edge(-thick)}));
  } else {
    builder.rod({mast - 0.1f * s.x, 0, boom + 2.f * pole}, {-0.75f * s.x, 0, boom + 2.f * pole}, 3.f * pole);
  }
  return builder.build();
}

/// Inflated tubes around a floor, a console and an outboard motor.
Model rib(const ShapeParams& p) {
  const Size s(p);
  const float tube = 0.24f * s.y, line = s.y - tube, up = 0.9f * tube;
  Builder builder;
  builder.use(paint(kWhite), "hull")
      .mesh(hull(Size({{"length", 1.8f * s.x}, {"width", 1.6f * s.y}, {"height", s.h}, {"draught", -s.keel}}),
                 0.6f * tube, 0.1f));
  builder.use(rubber(), "tube");
  for (const float side : {-1.f, 1.f}) {
    builder.rod({-s.x, side * line, up}, {0.45f * s.x, side * line, up}, tube);
    builder.rod({0.45f * s.x, side * line, up}, {s.x - tube, 0, 1.2f * up}, tube)
        .ball({0.45f * s.x, side * line, up}, tube);
  }
  builder.ball({s.x - tube, 0, 1.2f * up}, tube);
  builder.use(plastic(kGrey), "console")
      .box({-0.25f * s.x, -0.3f * s.y, 0.5f * tube}, {0.05f * s.x, 0.3f * s.y, 0.7f * s.h});
  builder.use(glass(), "window")
      .box({0.f, -0.28f * s.y, 0.7f * s.h}, {0.03f * s.x, 0.28f * s.y, 0.85f * s.h});
  builder.use(steel(), "mast").rod({-0.7f * s.x, -0.5f * s.y, up}, {-0.7f * s.x, -0.5f * s.y, s.h}, 0.03f);
  builder.rod({-0.7f * s.x, 0.5f * s.y, up}, {-0.7f * s.x, 0.5f * s.y, s.h}, 0.03f);
  builder.rod({-0.7f * s.x, -0.5f * s.y, s.h - 0.03f}, {-0.7f * s.x, 0.5f * s.y, s.h - 0.03f}, 0.03f);
  builder.use(matt(kBlack, 0.1f), "motor")
      .box({-s.x, -0.2f * s.y, 0.f}, {-0.86f * s.x, 0.2f * s.y, 0.55f * s.h});
  return builder.build();
}

/// A flat hull with a deckhouse behind, cargo and a crane: a workboat of a fish farm.
Model workBoat(const ShapeParams& p) {
  const Size s(p);
  const float deck = 0.28f * s.h, pole = 0.03f * s.h;
  Builder builder;
  builder.use(paint(kGrey), "hull")
      .mesh(frustum({-0.95f * s.x, 0.85f * s.x, -0.95f * s.y, 0.95f * s.y}, s.keel, {-s.x, s.x, -s.y, s.y},
                    deck));
  house(builder, {-0.9f * s.x, -0.45f * s.x, -0.7f * s.y, 0.3f * s.y}, deck,
        {-0.9f * s.x, -0.5f * s.x, -0.7f * s.y, 0.3f * s.y}, 0.85f * s.h);
  builder.use(paint(kYellow), "mast")
      .rod({0.2f * s.x, 0.6f * s.y, deck}, {0.2f * s.x, 0.6f * s.y, s.h - pole}, pole);
  builder.rod({0.2f * s.x, 0.6f * s.y, s.h - pole}, {0.75f * s.x, 0.3f * s.y, 0.7f * s.h}, pole);
  builder.use(plastic(kBlue), "gear")
      .box({-0.2f * s.x, -0.5f * s.y, deck}, {0.1f * s.x, 0.3f * s.y, 1.7f * deck});
  builder.use(rubber(), "fender");
  for (const float x : {-0.7f, -0.35f, 0.f, 0.35f, 0.7f})
    for (const float side : {-s.y, 0.93f * s.y})
      builder.box({x * s.x - 0.08f * s.x, side, 0.3f * deck},
                  {x * s.x + 0.08f * s.x, side + 0.07f * s.y, 0.95f * deck});
  return builder.build();
}

}  // namespace

ShapeKinds boatShapes() {
  return {
      {"boat",
       {"a small motor boat",
        {{"length", 6}, {"width", 2.2}, {"height", 2.4}, {"draught", 0.4}, {"cabin", 0.48}},
        boat}},
      {"fishing_boat",
       {"a small trawler", {{"length", 9}, {"width", 3}, {"height", 4.5}, {"draught", 0.8}}, fishingBoat}},
      {"rowing_boat",
       {"an open boat", {{"length", 3.6}, {"width", 1.4}, {"height", 0.6}, {"draught", 0.15}}, rowingBoat}},
      {"sailing_boat",
       {"a sloop; `sail` 0: furled",
        {{"length", 8}, {"width", 2.6}, {"height", 10}, {"draught", 0.6}, {"sail", 0}},
        sailingBoat}},
      {"rib",
       {"an inflatable boat with a console",
        {{"length", 5.5}, {"width", 2.2}, {"height", 1.9}, {"draught", 0.3}},
        rib}},
      {"work_boat",
       {"a flat boat with a crane",
        {{"length", 10}, {"width", 4}, {"height", 3.6}, {"draught", 0.6}},
        workBoat}},
  };
}

}  // namespace field_fusion::core::sim
