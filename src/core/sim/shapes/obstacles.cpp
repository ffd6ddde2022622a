// What stands in a laboratory or on a test track.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

struct ConeStyle {
  Vector3f colour;
  int bands = 1;
  float band = 0.2f;  // of the height over the base
  bool round = false;
};

/// On a base, with white bands.
Model trafficCone(const ShapeParams& p, const ConeStyle& style) {
  const float r = 0.5f * of(p, "diameter"), h = of(p, "height"), base = std::min(0.03f, 0.2f * h);
  const float foot = 0.75f * r, tip = 0.12f * r;
  const auto ring = [&](float share) {
    return Vector2f(foot + (tip - foot) * share, base + (h - base) * share);
  };
  Builder builder;
  builder.use(style.round ? rubber() : plastic(style.colour), "base");
  style.round ? builder.mesh(lathe({{r, 0}, {r, 0.7f * base}, {foot, base}}))
              : builder.box({-r, -r, 0}, {r, r, base});
  float below = 0.f;
  for (int i = 0; i < style.bands; ++i) {
    const float low = 0.6f - 0.5f * style.band +
                      0.33f * (static_cast<float>(i) - 0.5f * static_cast<float>(style.bands - 1));
    builder.use(plastic(style.colour), "body").mesh(lathe({ring(below), ring(low)}));
    builder.use(matt(kWhite, 0.85f), "band").mesh(lathe({ring(low), ring(low + style.band)}));
    below = low + style.band;
  }
  return builder.use(plastic(style.colour), "body").mesh(lathe({ring(below), ring(1.f)})).build();
}

template <int kBands>
Model roadCone(const ShapeParams& p) {
  return trafficCone(
      p, {kOrange, kBands, kBands > 0 ? std::clamp(of(p, "band"), 0.05f, 0.3f) : 0.f, of(p, "round") > 0.f});
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

}  // namespace

ShapeKinds obstacleShapes() {
  const ShapeParams cone = {{"diameter", 0.3}, {"height", 0.5}};
  const ShapeParams road = {{"diameter", 0.4}, {"height", 0.75}, {"band", 0.2}, {"round", 0}};
  return {
      {"red_cone",
       {"a red traffic cone on its base", cone, [](const ShapeParams& p) { return trafficCone(p, {kRed}); }}},
      {"blue_cone",
       {"a blue traffic cone on its base", cone,
        [](const ShapeParams& p) { return trafficCone(p, {kBlue}); }}},
      {"plain_cone",
       {"a traffic cone; `round` 1: on a round base",
        {{"diameter", 0.4}, {"height", 0.75}, {"round", 0}},
        roadCone<0>}},
      {"banded_cone", {"a traffic cone with a `band` of so much of its height", road, roadCone<1>}},
      {"road_cone", {"a traffic cone with two bands", road, roadCone<2>}},
      {"barrel", {"a steel drum", {{"diameter", 0.58}, {"height", 0.88}}, barrel}},
      {"radiator", {"a panel radiator on feet", {{"length", 1}, {"width", 0.12}, {"height", 0.6}}, radiator}},
      {"distribution_box",
       {"an electric cabinet, its door in front",
        {{"length", 0.3}, {"width", 0.5}, {"height", 0.7}},
        distributionBox}},
  };
}

}  // namespace field_fusion::core::sim
