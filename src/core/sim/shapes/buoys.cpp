// Buoys. z = 0 is the water.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

struct Size {
  float r, h, deep;

  explicit Size(const ShapeParams& p)
      : r(0.5f * of(p, "diameter")), h(of(p, "height")), deep(-of(p, "draught")) {}
};

/// A barrel-shaped body, a mast and a topmark.
Model buoy(const ShapeParams& p) {
  const Size s(p);
  const float top = std::min(0.35f * s.r, 0.12f * s.h);
  return Builder()
      .use(plastic(kRed), "body")
      .mesh(lathe({{0.6f * s.r, s.deep},
                   {s.r, 0.3f * s.deep},
                   {s.r, 0.2f * s.h},
                   {0.4f * s.r, 0.35f * s.h},
                   {0.15f * s.r, 0.6f * s.h}}))
      .use(steel(), "mast")
      .rod({0, 0, 0.6f * s.h}, {0, 0, s.h - top}, 0.06f * s.r)
      .use(plastic(kYellow), "topmark")
      .ball({0, 0, s.h - top}, top)
      .build();
}

/// A hollow ball with a neck and an eye to moor it by.
Model mooringBuoy(const ShapeParams& p) {
  const Size s(p);
  const float neck = 0.22f * s.r, top = 0.72f * s.h;
  std::vector<Vector2f> body;
  for (int i = 0; i <= 10; ++i) {
    const double angle = radians(-90.0 + 18.0 * i);
    body.emplace_back(std::max(0.02, std::cos(angle)) * s.r,
                      s.deep + 0.5 * (std::sin(angle) + 1.0) * (top - s.deep));
  }
  return Builder()
      .use(plastic(kOrange), "body")
      .mesh(lathe(body))
      .use(plastic(kBlack), "neck")
      .mesh(lathe({{1.5f * neck, 0.93f * top}, {neck, 1.1f * top}, {neck, 0.87f * s.h}}))
      .use(steel(), "mast")
      .rod({-1.2f * neck, 0, 0.93f * s.h}, {1.2f * neck, 0, 0.93f * s.h}, 0.07f * s.h)
      .build();
}

/// A can: a cylinder with a band, on a skirt.
Model canBuoy(const ShapeParams& p) {
  const Size s(p);
  const float body = 0.72f * s.r, low = 0.1f * s.h;
  return Builder()
      .use(plastic(kBlack), "skirt")
      .mesh(lathe({{0.8f * s.r, s.deep}, {s.r, 0.3f * s.deep}, {s.r, low}, {body, 1.5f * low}}))
      .use(plastic(kRed), "body")
      .mesh(lathe({{body, 1.5f * low}, {body, 0.5f * s.h}}))
      .mesh(lathe({{body, 0.68f * s.h}, {body, 0.9f * s.h}, {0.8f * body, 0.95f * s.h}}))
      .use(matt(kWhite, 0.8f), "band")
      .mesh(lathe({{body, 0.5f * s.h}, {body, 0.68f * s.h}}))
      .use(steel(), "mast")
      .rod({0, 0, 0.95f * s.h}, {0, 0, s.h}, 0.12f * s.r)
      .build();
}

/// A thin pole with bands on a float.
Model sparBuoy(const ShapeParams& p) {
  const Size s(p);
  const float pole = 0.28f * s.r;
  return Builder()
      .use(plastic(kOrange), "float")
      .mesh(lathe({{0.5f * s.r, s.deep}, {s.r, 0.2f * s.deep}, {s.r, 0.08f * s.h}, {pole, 0.16f * s.h}}))
      .use(plastic(kYellow), "body")
      .mesh(lathe({{pole, 0.16f * s.h}, {pole, 0.45f * s.h}}))
      .mesh(lathe({{pole, 0.65f * s.h}, {pole, 0.85f * s.h}}))
      .use(plastic(kBlack), "band")
      .mesh(lathe({{pole, 0.45f * s.h}, {pole, 0.65f * s.h}}))
      .use(cloth(kRed), "topmark")
      .mesh(lathe({{0.6f * s.r, 0.86f * s.h}, {0.05f * s.r, s.h}}))
      .build();
}

/// A nun: a cone with a blunt end.
Model nunBuoy(const ShapeParams& p) {
  const Size s(p);
  return Builder()
      .use(plastic(kGreen), "body")
      .mesh(
          lathe({{0.7f * s.r, s.deep}, {s.r, 0.25f * s.deep}, {s.r, 0.22f * s.h}, {0.22f * s.r, 0.9f * s.h}}))
      .use(steel(), "mast")
      .mesh(lathe({{0.22f * s.r, 0.9f * s.h}, {0.22f * s.r, s.h}}))
      .build();
}

/// A lattice tower on a broad float, two cones for a topmark and a lamp: a cardinal mark.
Model pillarBuoy(const ShapeParams& p) {
  const Size s(p);
  const float foot = 0.15f * s.h, head = 0.68f * s.h, bar = 0.05f * s.r;
  Builder builder;
  builder.use(plastic(kYellow), "body");
  builder.mesh(lathe({{0.8f * s.r, s.deep}, {s.r, 0.3f * s.deep}, {s.r, 0.1f * s.h}, {0.7f * s.r, foot}}));
  builder.use(plastic(kBlack), "mast");
  const auto corner = [&](int i, float reach, float z) {
    return Vector3f(i % 4 < 2 ? reach : -reach, i % 4 == 1 || i % 4 == 2 ? reach : -reach, z);
  };
  for (int i = 0; i < 4; ++i) {
    builder.rod(corner(i, 0.45f * s.r, foot), corner(i, 0.2f * s.r, head), bar);
    builder.rod(corner(i, 0.45f * s.r, foot), corner(i + 1, 0.25f * s.r, 0.8f * head), 0.7f * bar);
  }
  builder.rod({0, 0, head - bar}, {0, 0, head}, 0.35f * s.r).rod({0, 0, head}, {0, 0, s.h}, 0.8f * bar);
  builder.use(plastic(kBlack), "topmark");
  for (const float z : {0.74f, 0.87f})
    builder.mesh(lathe({{0.3f * s.r, z * s.h}, {0.02f * s.r, (z + 0.11f) * s.h}}));
  return builder.build();
}

}  // namespace

ShapeKinds buoyShapes() {
  return {
      {"buoy", {"a buoy with a topmark", {{"diameter", 0.8}, {"height", 1.6}, {"draught", 0.4}}, buoy}},
      {"mooring_buoy",
       {"a hollow ball with an eye", {{"diameter", 0.6}, {"height", 0.5}, {"draught", 0.15}}, mooringBuoy}},
      {"can_buoy", {"a can with a band", {{"diameter", 0.9}, {"height", 1.5}, {"draught", 0.4}}, canBuoy}},
      {"spar_buoy", {"a pole on a float", {{"diameter", 0.5}, {"height", 1.8}, {"draught", 0.4}}, sparBuoy}},
      {"nun_buoy", {"a blunt cone", {{"diameter", 0.9}, {"height", 1.6}, {"draught", 0.4}}, nunBuoy}},
      {"pillar_buoy",
       {"a cardinal mark", {{"diameter", 1.4}, {"height", 3.2}, {"draught", 0.6}}, pillarBuoy}},
  };
}

}  // namespace field_fusion::core::sim
