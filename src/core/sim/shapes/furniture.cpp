#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Model table(const ShapeParams& p) {
  const Extent e(p);
  const float top = std::min(0.03f, 0.2f * e.h), leg = 0.06f * std::min(e.x, e.y) + 0.02f;
  return Builder()
      .use(wood())
      .box({-e.x, -e.y, e.h - top}, {e.x, e.y, e.h})
      .fourLegs(e.x, e.y, leg, e.h - top)
      .build();
}

/// A table top on cupboards, as in a laboratory.
Model labTable(const ShapeParams& p) {
  const Extent e(p);
  return Builder()
      .use(plastic(kGrey))
      .box({-e.x, -e.y, 0.94f * e.h}, {e.x, e.y, e.h})
      .use(paint(kWhite))
      .box({-0.95f * e.x, -0.9f * e.y, 0.1f * e.h}, {0.95f * e.x, 0.9f * e.y, 0.94f * e.h})
      .use(matt(kBlack, 0.1f))
      .box({-0.9f * e.x, -0.8f * e.y, 0}, {0.9f * e.x, 0.8f * e.y, 0.1f * e.h})
      .build();
}

/// Slats on two trestles, with a back of two slats.
Model bench(const ShapeParams& p) {
  const Extent e(p);
  const float slat = 0.03f, trestle = 0.06f, seat = 0.5f * e.h;
  Builder builder;
  builder.use(wood());
  for (int i = 0; i < 4; ++i) {
    const float x = -e.x + 0.5f * e.x * static_cast<float>(i);
    builder.box({x, -e.y, seat - slat}, {x + 0.42f * e.x, e.y, seat});
  }
  for (const float z : {0.7f, 0.88f})
    builder.box({-e.x, -e.y, z * e.h}, {-e.x + slat, e.y, (z + 0.12f) * e.h});
  builder.use(steel());
  for (const float y : {-0.8f * e.y, 0.8f * e.y - trestle}) {
    builder.box({-e.x, y, 0}, {-e.x + trestle, y + trestle, 0.9f * e.h});
    builder.box({e.x - trestle, y, 0}, {e.x, y + trestle, seat - slat});
  }
  return builder.build();
}

Model shelf(const ShapeParams& p) {
  const Extent e(p);
  const float board = 0.02f;
  Builder builder;
  builder.use(wood());
  for (const float y : {-e.y, e.y - board}) builder.box({-e.x, y, 0}, {e.x, y + board, e.h});
  builder.box({-e.x, -e.y + board, 0}, {-e.x + 0.5f * board, e.y - board, e.h});
  for (int i = 0; i < 5; ++i) {
    const float z = 0.25f * static_cast<float>(i) * (e.h - board);
    builder.box({-e.x + 0.5f * board, -e.y + board, z}, {e.x, e.y - board, z + board});
  }
  return builder.build();
}

}  // namespace

ShapeKinds furnitureShapes() {
  return {
      {"table", {"a table on four legs", {{"length", 0.7}, {"width", 1.4}, {"height", 0.75}}, table}},
      {"experimental_table",
       {"a laboratory table on cupboards", {{"length", 1.5}, {"width", 3}, {"height", 0.8}}, labTable}},
      {"bench", {"a park bench", {{"length", 0.5}, {"width", 1.6}, {"height", 0.85}}, bench}},
      {"shelf", {"an open shelf", {{"length", 0.35}, {"width", 1}, {"height", 1.8}}, shelf}},
  };
}

}  // namespace field_fusion::core::sim
