// Chairs. Backs stand behind, at -x.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

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
  builder.use(cloth(kBlue), "seat")
      .box({-0.85f * e.x, -0.85f * e.y, seat - 2 * bar}, {e.x, 0.85f * e.y, seat + bar});
  builder.use(cloth(kBlue), "back").box({-e.x, -0.8f * e.y, 0.55f * e.h}, {-e.x + 3 * bar, 0.8f * e.y, e.h});
  builder.use(plastic(kBlack), "arm")
      .box({-0.95f * e.x, -0.15f * e.y, seat - bar}, {-0.85f * e.x, 0.15f * e.y, 0.7f * e.h});
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
  builder.use(plastic(kWhite), "seat")
      .box({-0.95f * e.x, -e.y + leg, seat - 0.4f * leg}, {e.x, e.y - leg, seat});
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
    builder.rod({e.x - bar, y, bar}, {-e.x + bar, y, e.h - bar}, bar)
        .rod({-e.x + bar, y, bar}, {0.7f * e.x, y, seat}, bar);
  }
  builder.box({e.x - 2 * bar, -e.y, 0}, {e.x, e.y, 2 * bar})
      .box({-e.x, -e.y, 0}, {-e.x + 2 * bar, e.y, 2 * bar});
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
  builder.use(cloth(kGreen), "back")
      .mesh(frustum({-e.x, -0.6f * e.x, -e.y, e.y}, 0.38f * e.h, {-e.x, -0.7f * e.x, -0.9f * e.y, 0.9f * e.y},
                    e.h));
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

}  // namespace

ShapeKinds chairShapes() {
  const ShapeParams chairs = {{"length", 0.45}, {"width", 0.45}, {"height", 0.9}};
  const ShapeParams easy = {{"length", 0.6}, {"width", 0.6}, {"height", 0.9}};
  return {
      {"chair", {"a chair with a full back", chairs, chair}},
      {"ladder_back",
       {"a chair with rungs for a back", {{"length", 0.45}, {"width", 0.45}, {"height", 1}}, ladderBack}},
      {"office_chair",
       {"a chair on castors", {{"length", 0.6}, {"width", 0.6}, {"height", 1.05}}, officeChair}},
      {"garden_chair", {"a chair of plastic with arms", easy, gardenChair}},
      {"folding_chair", {"a chair of two frames that cross", chairs, foldingChair}},
      {"armchair", {"an upholstered chair", {{"length", 0.8}, {"width", 0.85}, {"height", 0.9}}, armchair}},
      {"tube_chair", {"a chair on a bent tube", chairs, tubeChair}},
  };
}

}  // namespace field_fusion::core::sim
