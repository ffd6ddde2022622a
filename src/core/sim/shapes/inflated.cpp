// Decoys: cars of printed fabric, full of air.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// Across a body that lies along x: a rectangle with round corners, standing on the ground.
std::vector<Vector3f> slice(float x, float half, float top) {
  constexpr int kPoints = 28;
  std::vector<Vector3f> out;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = radians(360.0) * i / kPoints, c = std::cos(angle), s = std::sin(angle);
    const auto rounded = [](double v) {
      return static_cast<float>(std::copysign(std::sqrt(std::abs(v)), v));
    };
    out.emplace_back(x, half * rounded(c), 0.5f * top * (1.f + rounded(s)));
  }
  return out;
}

struct Station {
  float x, half, top;  // m
};

/// Through the stations, swollen between seams that pull it in.
Mesh swollen(const std::vector<Station>& stations, float seam) {
  constexpr int kSteps = 6;
  std::vector<std::vector<Vector3f>> rings;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    for (int j = 0; j < kSteps; ++j) {
      const float t = static_cast<float>(j) / kSteps;
      const float in = 1.f - seam * (1.f - std::sin(3.14159f * t));
      const auto mix = [&](float a, float b) { return a + t * (b - a); };
      const Station &a = stations[i], &b = stations[i + 1];
      rings.push_back(slice(mix(a.x, b.x), in * mix(a.half, b.half), mix(a.top, b.top)));
    }
  rings.push_back(slice(stations.back().x, (1.f - seam) * stations.back().half, stations.back().top));
  return loft(rings);
}

/// What is printed on the rear: a window, lamps, a plate.
void rearPrint(Builder& builder, float x, float y, float h) {
  const float thin = 0.015f * h;
  builder.use(matt({0.04f, 0.05f, 0.06f}, 0.2f), "print");
  builder.mesh(frustum({-x, -x + thin, -0.75f * y, 0.75f * y}, 0.58f * h,
                       {-x, -x + thin, -0.6f * y, 0.6f * y}, 0.85f * h));
  builder.box({-x, -0.85f * y, 0.1f * h}, {-x + thin, 0.85f * y, 0.2f * h});
  builder.use(matt(kRed, 0.85f), "lamp");
  for (const float side : {-0.88f * y, 0.58f * y})
    builder.box({-x, side, 0.43f * h}, {-x + thin, side + 0.3f * y, 0.54f * h});
  builder.use(matt(kWhite, 0.9f), "plate").box({-x, -0.28f * y, 0.3f * h}, {-x + thin, 0.28f * y, 0.38f * h});
}

/// The rear of a car alone, as carts pull it over test tracks.
Model balloonCar(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              rear = -x + 0.01f * h;
  Builder builder;
  builder.use(glossy(kBlue, 0.5f, 0.2f), "body");
  builder.mesh(swollen(
      {{rear, 0.97f * y, 0.98f * h}, {-0.5f * x, y, h}, {0.2f * x, y, h}, {x, 0.9f * y, 0.75f * h}}, 0.04f));
  rearPrint(builder, x, y, h);
  return builder.build();
}

/// A whole car; the `bonnet` is so long of it.
Model inflatedCar(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              rear = -x + 0.01f * h;
  const float bonnet = x - 2.f * x * std::clamp(of(p, "bonnet"), 0.05f, 0.5f);
  Builder builder;
  builder.use(glossy(kRed, 0.5f, 0.2f), "body");
  builder.mesh(swollen({{rear, 0.95f * y, 0.95f * h},
                        {-0.6f * x, y, h},
                        {0.5f * (bonnet - 0.6f * x), y, h},
                        {bonnet, y, 0.62f * h},
                        {x, 0.9f * y, 0.48f * h}},
                       0.05f));
  rearPrint(builder, x, y, h);
  builder.use(matt({0.04f, 0.05f, 0.06f}, 0.2f), "print");
  for (const float side : {-1.f, 1.f}) {
    for (const float at : {-0.62f * x, 0.62f * x}) {
      const float wheel = std::min(0.22f * h, 0.3f * x);
      builder.rod({at, side * 0.7f * y, wheel}, {at, side * 0.995f * y, wheel}, wheel);
    }
    const float inner = std::min(0.9f * y, 0.985f * y), outer = 0.99f * y;
    builder.box({-0.6f * x, side > 0 ? inner : -outer, 0.56f * h},
                {0.4f * (bonnet - 0.6f * x), side > 0 ? outer : -inner, 0.78f * h});
  }
  return builder.build();
}

}  // namespace

ShapeKinds inflatedShapes() {
  return {
      {"balloon_car",
       {"the inflated rear of a car (Fig. 5 of the off-road paper)",
        {{"length", 0.8}, {"width", 1.6}, {"height", 1.35}},
        balloonCar}},
      {"inflated_car",
       {"a whole inflated car",
        {{"length", 3.4}, {"width", 1.6}, {"height", 1.4}, {"bonnet", 0.3}},
        inflatedCar}},
  };
}

}  // namespace field_fusion::core::sim
