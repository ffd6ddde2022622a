// Quays and what lies at them. z = 0 is the water; a body reaches its draught below it.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

Model ringFloat(const ShapeParams& p) {
  const float tube = 0.5f * of(p, "tube");
  return Builder()
      .use(plastic(kBlack))
      .mesh(torus(0.5f * of(p, "diameter"), tube, tube - of(p, "draught")))
      .build();
}

/// Concrete from the sea bed to above the water, with a row of rubber fenders on its +y face.
Model quayWall(const ShapeParams& p) {
  const float x = 0.5f * of(p, "length"), y = 0.5f * of(p, "width"), h = of(p, "height"),
              fender = std::min(0.15f, 0.2f * y);
  Builder builder;
  builder.use(concrete()).box({-x, -y, -of(p, "draught")}, {x, y - fender, h}).use(rubber());
  const int fenders = std::max(1, static_cast<int>(x / 2.f));
  for (int i = 0; i < fenders; ++i) {
    const float at = -x + 2.f * x * (static_cast<float>(i) + 0.5f) / static_cast<float>(fenders);
    builder.box({at - 0.1f * fender - 0.1f, y - fender, -0.2f * h}, {at + 0.1f * fender + 0.1f, y, 0.8f * h});
  }
  return builder.build();
}

}  // namespace

ShapeKinds marineShapes() {
  return {
      {"ring_float",
       {"a ring of pipe, floating", {{"diameter", 2}, {"tube", 0.25}, {"draught", 0.12}}, ringFloat}},
      {"quay",
       {"a quay wall along x, its face towards y",
        {{"length", 20}, {"width", 3}, {"height", 1.5}, {"draught", 3}},
        quayWall}},
  };
}

}  // namespace field_fusion::core::sim
