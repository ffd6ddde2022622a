// They face x. Wheels stand on z = 0.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// A pair of wheels whose outer faces are `y` from the middle.
void axle(Builder& builder, float x, float y, float radius, float width) {
  builder.use(rubber());
  for (const float side : {-1.f, 1.f})
    builder.rod({x, side * (y - width), radius}, {x, side * y, radius}, radius);
}

/// The same height range of a body's four windows: a glass frustum a finger wider than the cabin.
void cabin(Builder& builder, const Eigen::Vector4f& below, float from, const Eigen::Vector4f& above, float to,
           const Vector3f& colour) {
  const auto level = [&](float share) { return Eigen::Vector4f(below + share * (above - below)); };
  const auto height = [&](float share) { return from + share * (to - from); };
  Material window = glass();
  window.transparency = 0.f;  // tinted: nothing is to be seen behind it
  builder.use(paint(colour));
  builder.mesh(frustum(level(0.f), height(0.f), level(0.15f), height(0.15f)));
  builder.mesh(frustum(level(0.85f), height(0.85f), above, to));
  builder.use(window).mesh(frustum(level(0.15f), height(0.15f), level(0.85f), height(0.85f)));
}

Model car(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  const float wheel = 0.22f * h, sill = 0.14f * h, belt = 0.62f * h;
  Builder builder;
  for (const float at : {-0.58f * x, 0.62f * x}) axle(builder, at, 0.98f * y, wheel, 0.22f * y);
  builder.use(paint(kBlue));
  builder.mesh(frustum({-x, x, -0.94f * y, 0.94f * y}, sill, {-x, x, -y, y}, 0.35f * h));
  builder.mesh(frustum({-x, x, -y, y}, 0.35f * h, {-0.97f * x, 0.95f * x, -0.95f * y, 0.95f * y}, belt));
  cabin(builder, {-0.88f * x, 0.42f * x, -0.9f * y, 0.9f * y}, belt,
        {-0.6f * x, 0.05f * x, -0.72f * y, 0.72f * y}, h, kBlue);
  builder.use(matt(kRed, 0.9f));  // reflectors
  for (const float side : {-0.92f * y, 0.7f * y})
    builder.box({-x, side, 0.45f * h}, {-0.96f * x, side + 0.22f * y, 0.53f * h});
  return builder.build();
}

Model truck(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  const float wheel = 0.15f * h, deck = 0.32f * h, front = 0.5f * x;
  Builder builder;
  for (const float at : {-0.7f * x, -0.42f * x, 0.68f * x}) axle(builder, at, 0.98f * y, wheel, 0.25f * y);
  builder.use(matt(kBlack, 0.15f)).box({-0.97f * x, -0.4f * y, 0.7f * wheel}, {0.95f * x, 0.4f * y, deck});
  builder.use(patterned(paint(kWhite), Material::Texture::kStripes, 0.3f, 0.9f * kWhite));
  builder.box({-x, -y, deck}, {front - 0.1f, y, h});
  builder.use(paint(kRed)).box({front, -0.96f * y, 0.8f * wheel}, {x, 0.96f * y, 0.5f * h});
  cabin(builder, {front, x, -0.96f * y, 0.96f * y}, 0.5f * h, {front, 0.92f * x, -0.9f * y, 0.9f * y},
        0.88f * h, kRed);
  return builder.build();
}

}  // namespace

ShapeKinds vehicleShapes() {
  return {
      {"car", {"a saloon car", {{"length", 4.4}, {"width", 1.8}, {"height", 1.45}}, car}},
      {"truck", {"a truck with a box body", {{"length", 8}, {"width", 2.5}, {"height", 3.4}}, truck}},
  };
}

}  // namespace field_fusion::core::sim
