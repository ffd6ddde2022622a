// What stands in a laboratory or on a test track.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// On a square base, with a white band.
Model trafficCone(const ShapeParams& p, const Vector3f& colour) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), base = std::min(0.03f, 0.2f * h);
  const float foot = 0.75f * r, tip = 0.12f * r;
  const auto radius = [&](float z) { return foot + (tip - foot) * (z - base) / (h - base); };
  const float low = base + 0.5f * (h - base), high = base + 0.7f * (h - base);
  return Builder()
      .use(plastic(colour))
      .box({-r, -r, 0}, {r, r, base})
      .mesh(lathe({{foot, base}, {radius(low), low}}))
      .mesh(lathe({{radius(high), high}, {tip, h}}))
      .use(matt(kWhite, 0.85f))
      .mesh(lathe({{radius(low), low}, {radius(high), high}}))
      .build();
}

Model barrel(const ShapeParams& p) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), in = 0.96f * r, hoop = 0.02f * h;
  return Builder()
      .use(paint(kBlue))
      .mesh(lathe({{r, 0},
                   {r, hoop},
                   {in, 2 * hoop},
                   {in, 0.32f * h},
                   {r, 0.33f * h},
                   {in, 0.34f * h},
                   {in, 0.66f * h},
                   {r, 0.67f * h},
                   {in, 0.68f * h},
                   {in, h - 2 * hoop},
                   {r, h - hoop},
                   {r, h}}))
      .build();
}

/// Two panels with ribs between them, on feet.
Model radiator(const ShapeParams& p) {
  const Vector3f half(0.5f * of(p, "length"), 0.5f * of(p, "width"), 0.f);
  const float h = of(p, "height"), feet = 0.15f * h, panel = 0.15f * of(p, "width");
  Builder builder;
  builder.use(paint(kWhite));
  builder.box({-half.x(), -half.y(), feet}, {half.x(), -half.y() + panel, h});
  builder.box({-half.x(), half.y() - panel, feet}, {half.x(), half.y(), h});
  const int ribs = std::max(2, static_cast<int>(of(p, "length") / 0.05f));
  for (int i = 0; i < ribs; ++i) {
    const float x =
        -half.x() + (2.f * half.x() - 0.01f) * static_cast<float>(i) / static_cast<float>(ribs - 1);
    builder.box({x, -half.y() + panel, feet}, {x + 0.01f, half.y() - panel, 0.98f * h});
  }
  for (const float x : {-0.8f * half.x(), 0.8f * half.x()})
    builder.box({x - 0.02f, -0.8f * half.y(), 0.f}, {x + 0.02f, 0.8f * half.y(), feet});
  return builder.build();
}

/// A steel cabinet with a door in front and a handle.
Model distributionBox(const ShapeParams& p) {
  const Vector3f half(0.5f * of(p, "length"), 0.5f * of(p, "width"), 0.f);
  const float h = of(p, "height"), door = 0.05f * of(p, "length");
  return Builder()
      .use(paint(kGrey))
      .box({-half.x(), -half.y(), 0}, {half.x() - 2 * door, half.y(), h})
      .use(paint({0.4f, 0.4f, 0.4f}))
      .box({half.x() - 2 * door, -0.92f * half.y(), 0.05f * h},
           {half.x() - door, 0.92f * half.y(), 0.95f * h})
      .use(plastic(kBlack))
      .box({half.x() - door, 0.6f * half.y(), 0.45f * h}, {half.x(), 0.75f * half.y(), 0.58f * h})
      .build();
}

/// The inflated rear of a car: rounded at the top.
Model balloonCar(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  return Builder()
      .use(glossy(kBlue, 0.5f, 0.2f))
      .mesh(frustum({-x, x, -0.95f * y, 0.95f * y}, 0, {-x, x, -y, y}, 0.25f * h))
      .mesh(frustum({-x, x, -y, y}, 0.25f * h, {-0.95f * x, x, -y, y}, 0.6f * h))
      .mesh(frustum({-0.8f * x, x, -0.9f * y, 0.9f * y}, 0.6f * h,
                    {-0.4f * x, 0.8f * x, -0.75f * y, 0.75f * y}, h))
      .use(matt(kRed, 0.85f))
      .box({-x, -0.9f * y, 0.45f * h}, {-0.96f * x, -0.6f * y, 0.55f * h})
      .box({-x, 0.6f * y, 0.45f * h}, {-0.96f * x, 0.9f * y, 0.55f * h})
      .build();
}

}  // namespace

ShapeKinds obstacleShapes() {
  const ShapeParams cone = {{"diameter", 0.3}, {"height", 0.5}};
  return {
      {"red_cone",
       {"a red traffic cone on its base", cone, [](const ShapeParams& p) { return trafficCone(p, kRed); }}},
      {"blue_cone",
       {"a blue traffic cone on its base", cone, [](const ShapeParams& p) { return trafficCone(p, kBlue); }}},
      {"barrel", {"a steel drum", {{"diameter", 0.58}, {"height", 0.88}}, barrel}},
      {"radiator", {"a panel radiator on feet", {{"length", 1}, {"width", 0.12}, {"height", 0.6}}, radiator}},
      {"distribution_box",
       {"an electric cabinet, its door in front",
        {{"length", 0.3}, {"width", 0.5}, {"height", 0.7}},
        distributionBox}},
      {"balloon_car",
       {"the inflated rear of a car (Fig. 5 of the off-road paper)",
        {{"length", 0.8}, {"width", 1.6}, {"height", 1.35}},
        balloonCar}},
  };
}

}  // namespace field_fusion::core::sim
