// What floats, and quays. z = 0 is the water; a body reaches its draught below it.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Vector3f onCircle(float radius, int i, int count, float z) {
  const double angle = radians(360.0) * i / count;
  return {radius * static_cast<float>(std::cos(angle)), radius * static_cast<float>(std::sin(angle)), z};
}

Model ringFloat(const ShapeParams& p) {
  const float tube = 0.5f * of(p, "tube");
  return Builder()
      .use(plastic(kBlack))
      .mesh(torus(0.5f * of(p, "diameter"), tube, tube - of(p, "draught")))
      .build();
}

/// A gravity cage of marine ranching, as in the USV paper: two floating rings of pipe, stanchions with a
/// handrail, and a net from there into the depth.
Model cage(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), tube = 0.5f * of(p, "tube");
  const float rail = std::min(0.4f * tube, 0.1f * h), middle = r - tube, inner = r - 3.2f * tube;
  const int posts = std::max(3, static_cast<int>(of(p, "posts")));
  Builder builder;
  builder.use(plastic(kBlack)).mesh(torus(r, tube, 0.f)).mesh(torus(inner + tube, tube, 0.f));
  builder.use(plastic(kOrange)).mesh(torus(inner + rail, rail, h - rail));
  builder.mesh(torus(inner + rail, rail, 0.5f * h));
  for (int i = 0; i < posts; ++i) {
    builder.rod(onCircle(inner, i, posts, 0.f), onCircle(inner, i, posts, h - rail), rail);
    builder.rod(onCircle(middle, i, posts, 0.f), onCircle(inner, i, posts, 0.5f * h), rail);  // a brace
  }
  const float hang = inner - rail, deep = -of(p, "draught");
  builder.use(sheer(matt(kGreen, 0.25f), of(p, "transparency")));
  builder.mesh(lathe({{0.02f * hang, deep}, {0.9f * hang, deep}, {hang, 0}, {hang, h - rail}}, false));
  return builder.build();
}

/// A pointed bow, a flat stern, a cabin and a mast.
Model boat(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              keel = -of(p, "draught");
  const float deck = 0.35f * h;
  const auto station = [&](float at, float wide, float bottom,
                           float top) {  // counter-clockwise seen from ahead
    return std::vector<Vector3f>{{at, -wide, top},
                                 {at, -0.8f * wide, 0.5f * bottom},
                                 {at, 0, bottom},
                                 {at, 0.8f * wide, 0.5f * bottom},
                                 {at, wide, top}};
  };
  Builder builder;
  builder.use(paint(kWhite));
  builder.mesh(loft({station(-x, 0.85f * y, 0.8f * keel, deck), station(-0.3f * x, y, keel, deck),
                     station(0.3f * x, 0.95f * y, keel, 1.05f * deck),
                     station(0.75f * x, 0.5f * y, 0.7f * keel, 1.15f * deck),
                     station(x, 0.02f * y, 0.2f * deck, 1.25f * deck)}));
  builder.use(paint(kBlue))
      .mesh(frustum({-0.4f * x, 0.3f * x, -0.6f * y, 0.6f * y}, 0.9f * deck,
                    {-0.35f * x, 0.1f * x, -0.5f * y, 0.5f * y}, 0.75f * h));
  builder.use(steel()).rod({-0.1f * x, 0, 0.75f * h}, {-0.1f * x, 0, h}, 0.03f);
  return builder.build();
}

/// A barrel-shaped body, a mast and a topmark.
Model buoy(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), deep = -of(p, "draught"),
              top = std::min(0.35f * r, 0.12f * h);
  return Builder()
      .use(plastic(kRed))
      .mesh(lathe(
          {{0.6f * r, deep}, {r, 0.3f * deep}, {r, 0.2f * h}, {0.4f * r, 0.35f * h}, {0.15f * r, 0.6f * h}}))
      .use(steel())
      .rod({0, 0, 0.6f * h}, {0, 0, h - top}, 0.06f * r)
      .use(plastic(kYellow))
      .ball({0, 0, h - top}, top)
      .build();
}

Model bollard(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height");
  return Builder()
      .use(matt({0.05f, 0.05f, 0.06f}, 0.15f))
      .mesh(lathe({{r, 0},
                   {r, 0.08f * h},
                   {0.6f * r, 0.15f * h},
                   {0.6f * r, 0.65f * h},
                   {r, 0.8f * h},
                   {r, 0.9f * h},
                   {0.6f * r, h}}))
      .build();
}

/// Concrete from the sea bed to above the water, with a row of rubber fenders on its +y face.
Model quayWall(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              fender = std::min(0.15f, 0.2f * y);
  Builder builder;
  builder.use(concrete()).box({-x, -y, -of(p, "draught")}, {x, y - fender, h}).use(rubber());
  const int fenders = std::max(1, static_cast<int>(x / 2.f));
  for (int i = 0; i < fenders; ++i) {
    const float at = -x + 2.f * x * (static_cast<float>(i) + 0.5f) / static_cast<float>(fenders);
    builder.box({at - 0.1f * fender - 0.1f, y - fender, -0.2f * h}, {at + 0.1f * fender + 0.1f, y, 0.8f * h});
  }
  return builder.build();
}

}  // namespace

ShapeKinds marineShapes() {
  return {
      {"ring_float",
       {"a ring of pipe, floating", {{"diameter", 2}, {"tube", 0.25}, {"draught", 0.12}}, ringFloat}},
      {"cage",
       {"a fish cage of marine ranching",
        {{"diameter", 2},
         {"height", 1},
         {"tube", 0.2},
         {"posts", 12},
         {"draught", 2},
         {"transparency", 0.75}},
        cage}},
      {"boat",
       {"a small motor boat", {{"length", 6}, {"width", 2.2}, {"height", 2.4}, {"draught", 0.4}}, boat}},
      {"buoy", {"a buoy with a topmark", {{"diameter", 0.8}, {"height", 1.6}, {"draught", 0.4}}, buoy}},
      {"bollard", {"a mooring bollard", {{"diameter", 0.35}, {"height", 0.5}}, bollard}},
      {"quay",
       {"a quay wall along x, its face towards y",
        {{"length", 20}, {"width", 3}, {"height", 1.5}, {"draught", 3}},
        quayWall}},
  };
}

}  // namespace field_fusion::core::sim
