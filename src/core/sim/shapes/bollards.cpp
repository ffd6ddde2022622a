// Posts on quays and beside roads.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Material castIron() { return matt({0.05f, 0.05f, 0.06f}, 0.15f); }

Model bollard(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height");
  return Builder()
      .use(castIron(), "body")
      .mesh(lathe({{r, 0},
                   {r, 0.08f * h},
                   {0.6f * r, 0.15f * h},
                   {0.6f * r, 0.65f * h},
                   {r, 0.8f * h},
                   {r, 0.9f * h},
                   {0.6f * r, h}}))
      .build();
}

/// Two posts with a bar across, on one plate.
Model twinBollard(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              post = 0.55f * std::min(x, y);
  Builder builder;
  builder.use(castIron(), "body").box({-x, -y, 0}, {x, y, 0.06f * h});
  for (const float side : {-1.f, 1.f}) {
    const Vector3f foot(0, side * (y - post), 0), neck(0, foot.y(), 0.88f * h), top(0, foot.y(), h);
    builder.rod(foot, neck, 0.8f * post).rod(neck, top, post);
  }
  return builder.rod({0, -y, 0.55f * h}, {0, y, 0.55f * h}, 0.5f * post).build();
}

/// A post beside a road, with a bright band and a rounded head.
Model streetBollard(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height");
  return Builder()
      .use(paint(kGrey), "body")
      .mesh(lathe({{r, 0}, {r, 0.05f * h}, {0.8f * r, 0.06f * h}, {0.8f * r, 0.7f * h}}))
      .mesh(lathe({{0.8f * r, 0.82f * h}, {0.8f * r, 0.93f * h}, {0.6f * r, 0.98f * h}, {0.2f * r, h}}))
      .use(matt(kWhite, 0.9f), "band")
      .mesh(lathe({{0.82f * r, 0.7f * h}, {0.82f * r, 0.82f * h}}))
      .build();
}

/// With a head like a T, for heavy lines.
Model teeBollard(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  return Builder()
      .use(castIron(), "body")
      .mesh(frustum({-x, x, -0.8f * y, 0.8f * y}, 0, {-0.6f * x, 0.6f * x, -0.45f * y, 0.45f * y}, 0.3f * h))
      .mesh(frustum({-0.6f * x, 0.6f * x, -0.45f * y, 0.45f * y}, 0.3f * h,
                    {-0.6f * x, 0.6f * x, -0.5f * y, 0.5f * y}, 0.7f * h))
      .mesh(frustum({-0.6f * x, 0.6f * x, -0.5f * y, 0.5f * y}, 0.7f * h, {-0.7f * x, 0.7f * x, -y, y},
                    0.85f * h))
      .mesh(frustum({-0.7f * x, 0.7f * x, -y, y}, 0.85f * h, {-0.5f * x, 0.5f * x, -0.9f * y, 0.9f * y}, h))
      .build();
}

/// Hewn of granite, tapered, with a pyramid on top.
Model stoneBollard(const ShapeParams& p) {
  const float x = 0.5f * of(p, "diameter"), h = of(p, "height"), in = 0.75f * x, tip = 0.2f * x;
  return Builder()
      .use(concrete(), "body")
      .mesh(frustum({-x, x, -x, x}, 0, {-in, in, -in, in}, 0.88f * h))
      .mesh(frustum({-in, in, -in, in}, 0.88f * h, {-tip, tip, -tip, tip}, h))
      .build();
}

}  // namespace

ShapeKinds bollardShapes() {
  return {
      {"bollard", {"a mooring bollard", {{"diameter", 0.35}, {"height", 0.5}}, bollard}},
      {"twin_bollard",
       {"two mooring posts on a plate", {{"length", 0.4}, {"width", 1}, {"height", 0.5}}, twinBollard}},
      {"street_bollard", {"a post beside a road", {{"diameter", 0.2}, {"height", 0.95}}, streetBollard}},
      {"tee_bollard",
       {"a mooring bollard with a head like a T",
        {{"length", 0.4}, {"width", 0.5}, {"height", 0.5}},
        teeBollard}},
      {"stone_bollard", {"a hewn post", {{"diameter", 0.35}, {"height", 0.8}}, stoneBollard}},
  };
}

}  // namespace field_fusion::core::sim
