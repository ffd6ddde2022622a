// What stands beside roads, paths and fields.
#include <stdexcept>

#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// Calls `each` at even places from -half to half, both ends included, at most `gap` apart.
template <class Each>
void along(float half, float gap, Each&& each) {
  const float wanted = std::ceil(2.f * half / gap);
  if (wanted > 10000.f) throw std::invalid_argument("gap must leave at most 10000 pieces");
  const int pieces = std::max(1, static_cast<int>(wanted));
  for (int i = 0; i <= pieces; ++i)
    each(-half + 2.f * half * static_cast<float>(i) / static_cast<float>(pieces));
}

/// Posts, two rails and pickets.
Model fence(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), h = of(p, "height"), post = 0.04f, picket = 0.015f;
  Builder builder;
  builder.use(wood());
  along(x - post, 2.f, [&](float at) { builder.box({at - post, -post, 0}, {at + post, post, h}); });
  for (const float z : {0.2f, 0.8f}) builder.box({-x, -0.02f, z * h}, {x, 0.02f, z * h + 0.06f});
  along(x - picket, of(p, "gap"), [&](float at) {
    builder.box({at - picket, 0.02f, 0.05f * h}, {at + picket, post, 0.95f * h});
  });
  return builder.build();
}

/// A sheet that some rays pass, in a rope.
Model net(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), h = of(p, "height"), rope = std::min(0.01f, 0.1f * h);
  Mesh sheet;
  sheet.vertices = {{-x, 0, rope}, {x, 0, rope}, {x, 0, h - rope}, {-x, 0, h - rope}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  Builder builder;
  builder.use(sheer(matt(kGreen, 0.3f), of(p, "transparency"))).mesh(sheet).use(matt(kGreen, 0.3f));
  for (const float z : {rope, h - rope}) builder.rod({-x, 0, z}, {x, 0, z}, rope);
  for (const float at : {rope - x, x - rope}) builder.rod({at, 0, 0}, {at, 0, h}, rope);
  return builder.build();
}

/// A beam with two waves on posts behind it (EN 1317's common shape).
Model guardrail(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  const float deep = std::min(0.08f, y), thick = 0.004f, low = h - 0.31f;
  const std::vector<Vector2f> wave = {{0, 0},     {deep, 0.05f}, {deep, 0.1f},  {0, 0.14f},
                                      {0, 0.17f}, {deep, 0.21f}, {deep, 0.26f}, {0, 0.31f}};
  Builder builder;
  builder.use(steel());
  for (std::size_t i = 0; i + 1 < wave.size(); ++i) {
    const auto ring = [&](float at) {  // one flat piece of the beam
      const Vector3f a(at, y - deep + wave[i].x(), low + wave[i].y()),
          b(at, y - deep + wave[i + 1].x(), low + wave[i + 1].y());
      const Vector3f in(0, -thick, 0);
      return std::vector<Vector3f>{a + in, a, b, b + in};
    };
    builder.mesh(loft({ring(-x), ring(x)}));
  }
  along(x - 0.05f, 2.f, [&](float at) {
    builder.box({at - 0.05f, -y, 0}, {at + 0.05f, y - deep - thick, h - 0.05f});
  });
  return builder.build();
}

/// Of plastic, filled with water; wider at the foot.
Model barrier(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  return Builder()
      .use(plastic(kBlue))
      .mesh(frustum({-x, x, -y, y}, 0, {-x, x, -y, y}, 0.2f * h))
      .mesh(frustum({-x, x, -y, y}, 0.2f * h, {-x, x, -0.45f * y, 0.45f * y}, 0.5f * h))
      .mesh(frustum({-x, x, -0.45f * y, 0.45f * y}, 0.5f * h, {-x, x, -0.35f * y, 0.35f * y}, h))
      .build();
}

/// A trunk, and balls of leaves that let some rays in.
Model tree(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), crown = std::min(h - 0.2f * h, 2.f * r);
  const float ball = std::min(0.55f * r, 0.45f * crown), reach = r - ball, middle = h - 0.5f * crown;
  Builder builder;
  builder.use(bark()).rod({0, 0, 0}, {0, 0, h - ball}, 0.5f * of(p, "trunk"));
  builder.use(sheer(leaves(), of(p, "transparency"))).ball({0, 0, h - ball}, ball);
  for (int i = 0; i < 8; ++i) {  // every other one reaches the side
    const double angle = radians(45.0) * i;
    const float up = (i % 3 - 1) * 0.4f * (0.5f * crown - ball), out = i % 2 ? 0.8f * reach : reach;
    builder.ball(
        {out * static_cast<float>(std::cos(angle)), out * static_cast<float>(std::sin(angle)), middle + up},
        ball);
  }
  return builder.build();
}

Model bush(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter");
  Builder builder;
  builder.use(sheer(leaves(), of(p, "transparency")));
  builder.mesh(lathe({{0.5f * r, 0},
                      {0.9f * r, 0.25f * of(p, "height")},
                      {r, 0.5f * of(p, "height")},
                      {0.8f * r, 0.8f * of(p, "height")},
                      {0.3f * r, of(p, "height")}}));
  return builder.build();
}

}  // namespace

ShapeKinds streetShapes() {
  return {
      {"fence", {"a picket fence along x", {{"length", 4}, {"height", 1.2}, {"gap", 0.12}}, fence}},
      {"net", {"a net along x in a rope", {{"length", 4}, {"height", 2}, {"transparency", 0.75}}, net}},
      {"guardrail",
       {"a guardrail along x; its beam faces y",
        {{"length", 4}, {"width", 0.3}, {"height", 0.75}},
        guardrail}},
      {"barrier",
       {"a blue barrier of plastic along x", {{"length", 2}, {"width", 0.5}, {"height", 0.9}}, barrier}},
      {"tree",
       {"a leafy tree", {{"diameter", 3}, {"height", 6}, {"trunk", 0.3}, {"transparency", 0.3}}, tree}},
      {"bush", {"a round bush", {{"diameter", 1.2}, {"height", 1}, {"transparency", 0.3}}, bush}},
  };
}

}  // namespace field_fusion::core::sim
