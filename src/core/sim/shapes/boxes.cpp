// Boxes to pack things in.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// Cardboard, a tape around it and an address.
Model parcel(const ShapeParams& p) {
  const Extent e(p);
  const float in = 0.006f * std::min({e.x, e.y, e.h}), tape = 0.08f * e.y;
  return Builder()
      .use(cardboard(), "body")
      .box({-e.x + in, -e.y + in, in}, {e.x - in, e.y - in, e.h - in})
      .use(glossy({0.55f, 0.45f, 0.3f}, 0.5f, 0.2f), "tape")
      .box({-e.x, -tape, 0}, {e.x, tape, e.h})
      .use(matt(kWhite, 0.7f), "label")
      .box({0.1f * e.x, -e.y, 0.5f * e.h}, {0.7f * e.x, e.y, 0.8f * e.h})
      .build();
}

/// Slats on posts, and braces across.
Model crate(const ShapeParams& p) {
  const Extent e(p);
  const float post = 0.1f * std::min(e.x, e.y), board = 0.4f * post;
  const int slats = std::max(3, static_cast<int>(e.h / 0.12f));
  Builder builder;
  builder.use(matt({0.1f, 0.07f, 0.04f}, 0.3f), "inside")
      .box({-e.x + 2 * post, -e.y + 2 * post, 0}, {e.x - 2 * post, e.y - 2 * post, 0.97f * e.h});
  builder.use(wood(), "post").fourLegs(e.x, e.y, post + board, e.h);
  builder.use(wood(), "body");
  for (int i = 0; i < slats; ++i) {
    const float step = e.h / static_cast<float>(slats), z = step * static_cast<float>(i),
                top = z + 0.8f * step;
    for (const float x : {-e.x + board, e.x - post})
      builder.box({x, -e.y + board, z}, {x + post - board, e.y - board, top});
    for (const float y : {-e.y + board, e.y - post})
      builder.box({-e.x + board, y, z}, {e.x - board, y + post - board, top});
  }
  return builder.build();
}

/// Of plastic, tapered, with a rim and ribs.
Model tote(const ShapeParams& p) {
  const Extent e(p);
  const float bx = 0.82f * e.x, by = 0.82f * e.y, tx = 0.93f * e.x, ty = 0.93f * e.y;
  Builder builder;
  builder.use(plastic(kBlue), "body").mesh(frustum({-bx, bx, -by, by}, 0, {-tx, tx, -ty, ty}, 0.9f * e.h));
  for (const float share : {-0.66f, -0.22f, 0.22f, 0.66f}) {
    const float wide = 0.03f;
    builder.box({share * bx - wide * e.x, -0.97f * e.y, 0.15f * e.h},
                {share * bx + wide * e.x, 0.97f * e.y, 0.9f * e.h});
    builder.box({-0.97f * e.x, share * by - wide * e.y, 0.15f * e.h},
                {0.97f * e.x, share * by + wide * e.y, 0.9f * e.h});
  }
  builder.use(plastic(kBlue), "rim").box({-e.x, -e.y, 0.86f * e.h}, {e.x, e.y, e.h});
  builder.use(matt(kBlack, 0.1f), "inside")
      .box({-0.85f * e.x, -0.85f * e.y, 0.99f * e.h}, {0.85f * e.x, 0.85f * e.y, e.h});
  return builder.build();
}

/// A cardboard box whose flaps stand up and out.
Model openBox(const ShapeParams& p) {
  const Extent e(p);
  const float wall = 0.75f * e.h, x = 0.75f * e.x, y = 0.75f * e.y, thick = 0.015f * e.x;
  Builder builder;
  builder.use(cardboard(), "body").box({-x, -y, 0}, {x, y, 0.98f * wall});
  builder.use(cardboard(), "flap");
  builder.mesh(frustum({x - thick, x, -y, y}, 0.9f * wall, {e.x - thick, e.x, -y, y}, e.h));
  builder.mesh(frustum({-x, -x + thick, -y, y}, 0.9f * wall, {-e.x, -e.x + thick, -y, y}, e.h));
  builder.mesh(frustum({-x, x, y - thick, y}, 0.9f * wall, {-x, x, e.y - thick, e.y}, 0.95f * e.h));
  builder.mesh(frustum({-x, x, -y, -y + thick}, 0.9f * wall, {-x, x, -e.y, -e.y + thick}, 0.95f * e.h));
  builder.use(matt(kBlack, 0.1f), "inside")
      .box({-0.95f * x, -0.95f * y, 0.97f * wall}, {0.95f * x, 0.95f * y, wall});
  return builder.build();
}

}  // namespace

ShapeKinds boxShapes() {
  const ShapeParams usual = {{"length", 0.6}, {"width", 0.4}, {"height", 0.4}};
  return {
      {"parcel", {"a cardboard box with tape and an address", usual, parcel}},
      {"crate", {"a wooden crate", usual, crate}},
      {"tote", {"a box of plastic with ribs", usual, tote}},
      {"open_box", {"a cardboard box, its flaps up", usual, openBox}},
  };
}

}  // namespace field_fusion::core::sim
