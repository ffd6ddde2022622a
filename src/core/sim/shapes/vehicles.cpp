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

/// The same height range of a body's four windows, with a post at each corner.
void cabin(Builder& builder, const Eigen::Vector4f& below, float from, const Eigen::Vector4f& above, float to,
           const Vector3f& colour) {
  const auto level = [&](float share) { return Eigen::Vector4f(below + share * (above - below)); };
  const auto height = [&](float share) { return from + share * (to - from); };
  Material window = glass();
  window.transparency = 0.f;  // tinted: nothing is to be seen behind it
  builder.use(paint(colour), "paint");
  builder.mesh(frustum(level(0.f), height(0.f), level(0.1f), height(0.1f)));
  builder.mesh(frustum(level(0.88f), height(0.88f), above, to));
  constexpr float kPost = 0.035f;
  for (const int x : {0, 1})
    for (const int y : {2, 3}) {
      const auto end = [&](float share) {
        return Vector3f(level(share)[x] + (x == 0 ? kPost : -kPost),
                        level(share)[y] + (y == 2 ? 0.015f : -0.015f), height(share));
      };
      builder.rod(end(0.1f), end(0.88f), kPost);
    }
  builder.use(window, "window").mesh(frustum(level(0.1f), height(0.1f), level(0.88f), height(0.88f)));
}

/// Outline of a car from the side, in shares of half its length and of its height.
struct CarStyle {
  float rear_foot, screen_foot;                      // where rear window and windscreen meet the belt
  float rear_head, screen_head;                      // where they meet the roof
  float belt = 0.62f, bonnet = 0.62f, tail = 0.62f;  // heights
};

void wheels(Builder& builder, float x, float y, float radius) {
  for (const float at : {-0.58f * x, 0.62f * x})
    for (const float side : {-1.f, 1.f}) {
      const auto disc = [&](float in, float out, float r, float up) {
        builder.rod({at, side * in, up}, {at, side * out, up}, r);
      };
      builder.use(matt(kBlack, 0.1f), "arch");
      disc(0.7f * y, 0.955f * y, 1.15f * radius, 1.15f * radius);
      builder.use(rubber(), "tyre");
      disc(0.75f * y, 0.985f * y, radius, radius);
      builder.use(steel(), "rim");
      disc(0.9f * y, 0.992f * y, 0.62f * radius, radius);
    }
}

void lamps(Builder& builder, float x, float y, float h) {
  builder.use(matt(kRed, 0.9f), "tail_lamp");
  for (const float side : {-0.92f * y, 0.7f * y})
    builder.box({-x, side, 0.43f * h}, {-0.96f * x, side + 0.22f * y, 0.53f * h});
  builder.use(glossy(kWhite, 0.8f, 0.4f), "lamp");
  for (const float side : {-0.92f * y, 0.62f * y})
    builder.box({0.96f * x, side, 0.41f * h}, {0.995f * x, side + 0.3f * y, 0.49f * h});
  builder.use(matt(kBlack, 0.1f), "trim");
  builder.box({0.9f * x, -0.5f * y, 0.3f * h}, {x, 0.5f * y, 0.44f * h});
  builder.box({-x, -0.9f * y, 0.2f * h}, {-0.9f * x, 0.9f * y, 0.27f * h});
  builder.use(matt(kWhite, 0.9f), "plate");
  builder.box({-x, -0.3f * y, 0.3f * h}, {-0.95f * x, 0.3f * y, 0.37f * h});
}

/// Wheels, body, windows, lamps, doors and mirrors.
Model carOf(const ShapeParams& p, const CarStyle& s) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  const float wheel = 0.22f * h, sill = 0.14f * h, side = 0.95f * y, belt = s.belt * h, waist = 0.42f * h;
  Builder builder;
  wheels(builder, x, y, wheel);
  builder.use(paint(kBlue), "paint");
  builder.mesh(frustum({-0.995f * x, x, -0.9f * y, 0.9f * y}, sill, {-0.995f * x, x, -side, side}, waist));
  const float front = 0.97f * x, rear = -0.98f * x, mid = s.screen_foot * x, back = s.rear_foot * x;
  builder.mesh(
      frustum({-0.995f * x, x, -side, side}, waist, {back - 0.01f * x, mid, -0.93f * y, 0.93f * y}, belt));
  builder.mesh(frustum({mid - 0.1f * x, x, -side, side}, waist,
                       {mid - 0.1f * x, front, -0.88f * y, 0.88f * y}, s.bonnet * h));
  builder.mesh(frustum({-0.995f * x, back + 0.1f * x, -side, side}, waist,
                       {rear, back + 0.1f * x, -0.9f * y, 0.9f * y}, s.tail * h));
  cabin(builder, {back, mid, -0.9f * y, 0.9f * y}, belt,
        {s.rear_head * x, s.screen_head * x, -0.72f * y, 0.72f * y}, h, kBlue);
  builder.use(matt(kBlack, 0.1f), "trim");
  for (const float at : {0.5f * (back + mid) - 0.01f * x, mid - 0.06f * x})  // gaps of the doors
    for (const float door : {-side - 0.001f, side - 0.01f})
      builder.box({at, door, 0.2f * h}, {at + 0.008f * x, door + 0.011f, waist});
  for (const float door : {-y, y - 0.08f * y})
    builder.box({mid - 0.12f * x, door, belt}, {mid - 0.06f * x, door + 0.08f * y, belt + 0.09f * h});
  lamps(builder, x, y, h);
  return builder.build();
}

Model car(const ShapeParams& p) { return carOf(p, {-0.74f, 0.42f, -0.5f, 0.05f, 0.62f, 0.58f, 0.62f}); }
Model hatchback(const ShapeParams& p) { return carOf(p, {-0.93f, 0.5f, -0.72f, 0.12f, 0.6f, 0.57f, 0.6f}); }
Model suv(const ShapeParams& p) { return carOf(p, {-0.94f, 0.4f, -0.84f, 0.16f, 0.6f, 0.58f, 0.6f}); }
Model estate(const ShapeParams& p) { return carOf(p, {-0.95f, 0.36f, -0.82f, 0.06f, 0.6f, 0.56f, 0.6f}); }
Model van(const ShapeParams& p) { return carOf(p, {-0.97f, 0.72f, -0.96f, 0.5f, 0.54f, 0.46f, 0.54f}); }

/// A cabin before an open bed.
Model pickup(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"), wall = 0.06f * y;
  Model model = carOf(p, {-0.12f, 0.48f, -0.08f, 0.2f, 0.6f, 0.58f, 0.44f});
  Builder bed;
  bed.use(paint(kBlue), "paint").box({-0.98f * x, -0.93f * y, 0.4f * h}, {-0.95f * x, 0.93f * y, 0.58f * h});
  for (const float side : {-0.93f * y, 0.93f * y - wall})
    bed.box({-0.98f * x, side, 0.4f * h}, {-0.1f * x, side + wall, 0.58f * h});
  const Model behind = bed.build();
  auto& parts = model.links.front().parts;
  parts.insert(parts.end(), behind.links.front().parts.begin(), behind.links.front().parts.end());
  return model;
}

Model truck(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height");
  const float wheel = 0.15f * h, deck = 0.32f * h, front = 0.5f * x;
  Builder builder;
  for (const float at : {-0.7f * x, -0.42f * x, 0.68f * x}) axle(builder, at, 0.98f * y, wheel, 0.25f * y);
  builder.use(matt(kBlack, 0.15f)).box({-0.97f * x, -0.4f * y, 0.7f * wheel}, {0.95f * x, 0.4f * y, deck});
  builder.use(patterned(paint(kWhite), Material::Texture::kStripes, 0.3f, 0.9f * kWhite), "body");
  builder.box({-x, -y, deck}, {front - 0.1f, y, h});
  builder.use(paint(kRed), "paint").box({front, -0.96f * y, 0.8f * wheel}, {x, 0.96f * y, 0.5f * h});
  cabin(builder, {front, x, -0.96f * y, 0.96f * y}, 0.5f * h, {front, 0.92f * x, -0.9f * y, 0.9f * y},
        0.88f * h, kRed);
  return builder.build();
}

}  // namespace

ShapeKinds vehicleShapes() {
  return {
      {"car", {"a saloon car", {{"length", 4.4}, {"width", 1.8}, {"height", 1.45}}, car}},
      {"hatchback", {"a small car", {{"length", 3.9}, {"width", 1.7}, {"height", 1.5}}, hatchback}},
      {"suv", {"a high car", {{"length", 4.5}, {"width", 1.85}, {"height", 1.7}}, suv}},
      {"estate", {"a long car", {{"length", 4.7}, {"width", 1.8}, {"height", 1.48}}, estate}},
      {"van", {"a delivery van", {{"length", 5}, {"width", 1.95}, {"height", 2.1}}, van}},
      {"pickup", {"a car with an open bed", {{"length", 5.2}, {"width", 1.9}, {"height", 1.8}}, pickup}},
      {"truck", {"a truck with a box body", {{"length", 8}, {"width", 2.5}, {"height", 3.4}}, truck}},
  };
}

}  // namespace field_fusion::core::sim
