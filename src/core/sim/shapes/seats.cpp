// Chairs and stools. Backs stand behind, at -x.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

struct Extent {
  float x, y, h;  // half, half, all

  explicit Extent(const ShapeParams& p)
      : x(0.5f * of(p, "length")), y(0.5f * of(p, "width")), h(of(p, "height")) {}
};

/// Seat at half the height.
Builder seat(const Extent& e, float leg) {
  Builder builder;
  builder.use(wood(), "seat").box({-e.x, -e.y, 0.5f * e.h - leg}, {e.x, e.y, 0.5f * e.h});
  builder.use(wood(), "leg").fourLegs(e.x, e.y, leg, 0.5f * e.h - leg);
  return builder;
}

Model chair(const ShapeParams& p) {
  const Extent e(p);
  const float leg = 0.12f * e.x;
  return seat(e, leg).use(wood(), "back").box({-e.x, -e.y, 0.5f * e.h}, {-e.x + leg, e.y, e.h}).build();
}

/// Two posts with rungs between them.
Model ladderBack(const ShapeParams& p) {
  const Extent e(p);
  const float leg = 0.12f * e.x;
  Builder builder = seat(e, leg);
  builder.use(wood(), "back");
  for (const float y : {-e.y, e.y - leg}) builder.box({-e.x, y, 0.5f * e.h}, {-e.x + leg, y + leg, e.h});
  for (const float z : {0.62f, 0.77f, 0.92f})
    builder.box({-e.x, -e.y + leg, z * e.h}, {-e.x + 0.5f * leg, e.y - leg, (z + 0.05f) * e.h});
  return builder.build();
}

/// Five castors, a column, arms.
Model officeChair(const ShapeParams& p) {
  const Extent e(p);
  const float r = std::min(e.x, e.y), seat = 0.45f * e.h, bar = 0.06f * r;
  Builder builder;
  builder.use(plastic(kBlack), "base");
  for (int i = 0; i < 5; ++i) {
    const double angle = radians(72.0) * i;
    const Vector3f out(0.86f * r * std::cos(angle), 0.86f * r * std::sin(angle), 2.4f * bar);
    builder.rod({0, 0, 3.5f * bar}, out, bar).ball(out - Vector3f(0, 0, bar), 1.4f * bar);
  }
  builder.use(steel(), "column").rod({0, 0, 3 * bar}, {0, 0, seat - bar}, 1.2f * bar);
  builder.use(cloth(kBlue), "seat").box({-0.85f * e.x, -0.85f * e.y, seat - 2 * bar}, {e.x, 0.85f * e.y, seat + bar});
  builder.use(cloth(kBlue), "back").box({-e.x, -0.8f * e.y, 0.55f * e.h}, {-e.x + 3 * bar, 0.8f * e.y, e.h});
  builder.use(plastic(kBlack), "arm").box({-0.95f * e.x, -0.15f * e.y, seat - bar}, {-0.85f * e.x, 0.15f * e.y, 0.7f * e.h});
  for (const float side : {-e.y, e.y - 1.5f * bar}) {
    builder.box({-0.5f * e.x, side, 0.64f * e.h}, {0.5f * e.x, side + 1.5f * bar, 0.67f * e.h});
    builder.box({-0.1f * e.x, side, seat - bar}, {0.1f * e.x, side + 1.5f * bar, 0.65f * e.h});
  }
  return builder.build();
}

/// Of plastic, with arms and an upright slatted back.
Model gardenChair(const ShapeParams& p) {
  const Extent e(p);
  const float leg = 0.13f * e.x, seat = 0.48f * e.h, arm = 0.7f * e.h;
  Builder builder;
  builder.use(plastic(kWhite), "leg");
  for (const float y : {-e.y, e.y - leg}) {
    builder.box({e.x - leg, y, 0}, {e.x, y + leg, arm}).box({-e.x, y, 0}, {-e.x + leg, y + leg, arm});
    builder.box({-e.x, y, arm}, {e.x, y + leg, arm + 0.5f * leg});
  }
  builder.use(plastic(kWhite), "seat").box({-0.95f * e.x, -e.y + leg, seat - 0.4f * leg}, {e.x, e.y - leg, seat});
  builder.use(plastic(kWhite), "back");
  const float wide = 2.f * (e.y - leg) / 9.f;
  for (int i = 0; i < 9; i += 2) {
    const float y = -e.y + leg + wide * static_cast<float>(i);
    builder.box({-e.x, y, seat}, {-e.x + 0.4f * leg, y + wide, 0.95f * e.h});
  }
  return builder.box({-e.x, -e.y + leg, 0.93f * e.h}, {-e.x + 0.5f * leg, e.y - leg, e.h}).build();
}

/// Two frames that cross, a seat and a back of boards.
Model foldingChair(const ShapeParams& p) {
  const Extent e(p);
  const float bar = 0.06f * e.x, seat = 0.5f * e.h, in = e.y - bar;
  Builder builder;
  builder.use(steel(), "leg");
  for (const float y : {-in, in}) {
    builder.rod({e.x - bar, y, bar}, {-e.x + bar, y, e.h - bar}, bar).rod({-e.x + bar, y, bar}, {0.7f * e.x, y, seat}, bar);
  }
  builder.box({e.x - 2 * bar, -e.y, 0}, {e.x, e.y, 2 * bar}).box({-e.x, -e.y, 0}, {-e.x + 2 * bar, e.y, 2 * bar});
  builder.use(wood(), "seat").box({-0.35f * e.x, -in, seat}, {0.9f * e.x, in, seat + 1.5f * bar});
  builder.use(wood(), "back").box({-e.x, -e.y, 0.8f * e.h}, {-e.x + 3 * bar, e.y, e.h});
  return builder.build();
}

/// Upholstered, on short feet.
Model armchair(const ShapeParams& p) {
  const Extent e(p);
  const float feet = 0.1f * e.h, arm = 0.25f * e.y;
  Builder builder;
  builder.use(wood(), "leg").fourLegs(0.9f * e.x, 0.9f * e.y, 0.08f * e.x, feet);
  builder.use(cloth(kGreen), "seat").box({-e.x, -e.y, feet}, {e.x, e.y, 0.38f * e.h});
  builder.box({-0.6f * e.x, -e.y + arm, 0.38f * e.h}, {0.97f * e.x, e.y - arm, 0.5f * e.h});
  builder.use(cloth(kGreen), "arm");
  for (const float y : {-e.y, e.y - arm}) {
    builder.box({-e.x, y, 0.38f * e.h}, {e.x, y + arm, 0.6f * e.h});
    builder.rod({-e.x, y + 0.5f * arm, 0.6f * e.h}, {e.x, y + 0.5f * arm, 0.6f * e.h}, 0.5f * arm);
  }
  builder.use(cloth(kGreen), "back").mesh(frustum({-e.x, -0.6f * e.x, -e.y, e.y}, 0.38f * e.h, {-e.x, -0.7f * e.x, -0.9f * e.y, 0.9f * e.y}, e.h));
  return builder.build();
}

/// A bent tube on the floor carries the seat from in front.
Model tubeChair(const ShapeParams& p) {
  const Extent e(p);
  const float tube = 0.06f * e.x, seat = 0.52f * e.h, front = e.x - tube, rear = -e.x + tube;
  Builder builder;
  builder.use(steel(), "leg");
  for (const float y : {-e.y + tube, e.y - tube}) {
    builder.rod({rear, y, tube}, {front, y, tube}, tube).rod({front, y, tube}, {front, y, seat}, tube);
    builder.rod({front, y, seat}, {rear, y, seat}, tube).rod({rear, y, seat}, {rear, y, e.h}, tube);
  }
  builder.rod({rear, -e.y + tube, tube}, {rear, e.y - tube, tube}, tube);
  builder.use(cloth(kBlack), "seat").box({-0.85f * e.x, -e.y, seat}, {e.x, e.y, seat + 1.5f * tube});
  builder.use(cloth(kBlack), "back").box({-e.x, -e.y, 0.72f * e.h}, {-e.x + 2.5f * tube, e.y, e.h});
  return builder.build();
}

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
  builder.use(steel(), "leg").mesh(lathe({{r, 0}, {r, 0.02f * h}, {0.3f * r, 0.04f * h}, {column, 0.08f * h}, {column, 0.85f * h}}));
  builder.mesh(torus(0.65f * r, 0.06f * r, 0.35f * h)).rod({-0.6f * r, 0, 0.35f * h}, {0.6f * r, 0, 0.35f * h}, 0.06f * r);
  builder.use(plastic(kRed), "seat").mesh(lathe({{0.6f * r, 0.85f * h}, {0.9f * r, 0.88f * h}, {0.95f * r, 0.97f * h}, {0.8f * r, h}}));
  return builder.build();
}

Model squareStool(const ShapeParams& p) {
  const Extent e(p);
  const float leg = 0.13f * std::min(e.x, e.y), top = 0.1f * e.h;
  Builder builder;
  builder.use(wood(), "seat").box({-e.x, -e.y, e.h - top}, {e.x, e.y, e.h});
  builder.use(wood(), "leg").fourLegs(0.97f * e.x, 0.97f * e.y, leg, e.h - top);
  for (const float x : {-0.95f * e.x, 0.95f * e.x - 0.7f * leg}) builder.box({x, -0.9f * e.y, 0.3f * e.h}, {x + 0.7f * leg, 0.9f * e.y, 0.36f * e.h});
  return builder.build();
}

/// Crossed legs and a seat of cloth.
Model foldingStool(const ShapeParams& p) {
  const Extent e(p);
  const float bar = 0.07f * e.x, in = e.x - bar;
  Builder builder;
  builder.use(wood(), "leg");
  for (const float y : {-e.y + bar, e.y - bar}) builder.rod({-in, y, bar}, {in, y, e.h - bar}, bar).rod({in, y, bar}, {-in, y, e.h - bar}, bar);
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
  for (const float y : {-0.8f * e.y, 0.8f * e.y - board}) builder.mesh(frustum({-0.95f * e.x, 0.95f * e.x, y, y + board}, 0, {-0.75f * e.x, 0.75f * e.x, y, y + board}, e.h - board));
  return builder.box({-0.1f * e.x, -0.75f * e.y, 0.4f * e.h}, {0.1f * e.x, 0.75f * e.y, 0.6f * e.h}).build();
}

}  // namespace

ShapeKinds seatShapes() {
  const ShapeParams chairs = {{"length", 0.45}, {"width", 0.45}, {"height", 0.9}};
  const ShapeParams easy = {{"length", 0.6}, {"width", 0.6}, {"height", 0.9}};
  const ShapeParams stools = {{"length", 0.35}, {"width", 0.35}, {"height", 0.45}};
  return {
      {"chair", {"a chair with a full back", chairs, chair}},
      {"ladder_back", {"a chair with rungs for a back", {{"length", 0.45}, {"width", 0.45}, {"height", 1}}, ladderBack}},
      {"office_chair", {"a chair on castors", {{"length", 0.6}, {"width", 0.6}, {"height", 1.05}}, officeChair}},
      {"garden_chair", {"a chair of plastic with arms", easy, gardenChair}},
      {"folding_chair", {"a chair of two frames that cross", chairs, foldingChair}},
      {"armchair", {"an upholstered chair", {{"length", 0.8}, {"width", 0.85}, {"height", 0.9}}, armchair}},
      {"tube_chair", {"a chair on a bent tube", chairs, tubeChair}},
      {"stool", {"a round stool; `splay` of the legs 0..0.7", {{"diameter", 0.35}, {"height", 0.45}, {"legs", 3}, {"splay", 0}}, stool}},
      {"bar_stool", {"a stool on a column", {{"diameter", 0.42}, {"height", 0.75}}, barStool}},
      {"square_stool", {"a stool on four legs", stools, squareStool}},
      {"folding_stool", {"a stool of crossed legs", {{"length", 0.4}, {"width", 0.35}, {"height", 0.45}}, foldingStool}},
      {"board_stool", {"a stool of three boards", stools, boardStool}},
  };
}

}  // namespace field_fusion::core::sim
