// People and dummies. Body proportions of a standing adult after Drillis and Contini (1966), as shares of the
// height: hip 0.53, knee 0.285, shoulder 0.818, elbow 0.63.
#include <algorithm>
#include <cmath>

#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kHip = 0.53f, kKnee = 0.285f, kShoulder = 0.818f, kElbow = 0.63f, kHand = 0.485f;

/// How legs and arms swing so that a foot steps as far as the body goes: the step grows with the square root
/// of the speed, and a leg of length L reaches asin(step / 2 L) to both sides.
struct Gait {
  double swing = 0.0, period = 1.0;  ///< [rad], [s] of two steps

  Gait(double height, double speed) {
    if (speed <= 0.0) return;
    const double step = std::min(0.42 * height * std::sqrt(speed / 1.35), 0.8 * height * kHip);
    swing = std::asin(step / (2.0 * height * kHip));
    period = 2.0 * step / speed;
  }
};

struct Dress {
  Material skin, shirt, trousers, shoes, hair;
};

struct Figure {
  Builder builder;
  float h, breadth;
  Gait gait;
  Dress dress;

  Joint swinging(const Vector3f& pivot, double amplitude, double phase, double bias) const {
    Joint joint;  // forwards is positive: about -y
    joint.pivot = pivot.cast<double>(), joint.axis = -Eigen::Vector3d::UnitY();
    joint.amplitude = amplitude, joint.period = gait.period, joint.phase = phase, joint.bias = bias;
    return joint;
  }
  void rounded(const Vector3f& from, const Vector3f& to, float radius) {
    builder.rod(from, to, radius).ball(from, radius).ball(to, radius);
  }
  void trunk() {
    const float deep = 0.065f * h, wide = breadth - 0.06f * h;
    Mesh torso = lathe({{0.8f, kHip * h - 0.03f * h},
                        {0.95f, kHip * h},
                        {0.8f, 0.64f * h},
                        {1.f, 0.76f * h},
                        {0.75f, kShoulder * h},
                        {0.25f, 0.84f * h}});
    for (Vector3f& v : torso.vertices) v.x() *= deep, v.y() *= wide;
    const float head = 0.065f * h;
    builder.use(dress.shirt, "shirt").mesh(torso).use(dress.skin, "skin");
    builder.rod({0, 0, 0.83f * h}, {0, 0, h - head}, 0.035f * h);
    builder.ball({0, 0, h - head}, head).ball({0.02f * h, 0, h - 1.4f * head}, 0.7f * head);
  }
  /// Around the trunk from one height to another, shares of the person's; wider by `more`.
  void around(float from, float to, float more) {
    Mesh cloth =
        lathe({{0.95f + more, from * h}, {0.97f + more, 0.5f * (from + to) * h}, {0.85f + more, to * h}});
    for (Vector3f& v : cloth.vertices) v.x() *= 0.068f * h, v.y() *= breadth - 0.06f * h;
    builder.mesh(cloth);
  }
  void hair() {
    const float head = 0.065f * h, z = h - head;
    Mesh cap = lathe({{0.9f * head, z - 0.3f * head},
                      {1.06f * head, z + 0.1f * head},
                      {0.85f * head, z + 0.7f * head},
                      {0.1f * head, h}});
    for (Vector3f& v : cap.vertices) v.x() -= 0.012f * h;
    builder.use(dress.hair, "hair").mesh(cap);
  }
  /// Hard, with a brim.
  void helmet() {
    const float head = 0.065f * h, z = h - head;
    builder.use(plastic(kYellow), "helmet");
    builder.mesh(lathe({{1.35f * head, z + 0.2f * head},
                        {1.1f * head, z + 0.3f * head},
                        {0.8f * head, z + 0.8f * head},
                        {0.1f * head, h}}));
  }
  /// `side` is -1 or 1; the phases of the two sides are half a period apart.
  void leg(float side) {
    const float y = side * 0.052f * h, ankle = 0.04f * h;
    const double phase = side > 0 ? 0.0 : radians(180.0), bend = gait.swing * 0.9;
    const Vector3f hip(0, y, kHip * h), knee(0, y, kKnee * h);
    const int thigh = builder.link(swinging(hip, gait.swing, phase, 0.0));
    builder.use(dress.trousers, "trousers");
    rounded(hip, knee, 0.048f * h);
    // the knee is straight while the foot stands and bent most while the thigh swings forwards
    builder.link(swinging(knee, -bend, phase + radians(90.0), -bend), thigh);
    builder.use(dress.trousers, "trousers").rod(knee, {0, y, ankle}, 0.036f * h);
    builder.use(dress.shoes, "shoes")
        .box({-0.04f * h, y - 0.028f * h, 0}, {0.11f * h, y + 0.028f * h, ankle});
  }
  void arm(float side) {
    const float y = side * (breadth - 0.03f * h);
    const double phase = side > 0 ? radians(180.0) : 0.0;  // against the leg
    const Vector3f shoulder(0, y, kShoulder * h - 0.03f * h), elbow(0, y, kElbow * h), hand(0, y, kHand * h);
    const int upper = builder.link(swinging(shoulder, 0.8 * gait.swing, phase, 0.0));
    builder.use(dress.shirt, "shirt");
    rounded(shoulder, elbow, 0.028f * h);
    builder.link(swinging(elbow, 0.3 * gait.swing, phase, 0.3 * gait.swing), upper);
    builder.use(dress.skin, "skin").rod(elbow, hand, 0.024f * h).ball(hand, 0.03f * h);
  }
};

Model person(const ShapeParams& p) {
  const float h = of(p, "height");
  Figure figure{{},
                h,
                0.5f * of(p, "width"),
                Gait(h, p.at("speed")),
                {skin(), cloth(kRed), cloth(kBlue), matt(kBlack, 0.1f), matt({0.06f, 0.04f, 0.02f}, 0.4f)}};
  figure.trunk();
  of(p, "helmet") > 0.f ? figure.helmet() : figure.hair();
  Builder& builder = figure.builder;
  if (of(p, "vest") > 0.f) builder.use(cloth(kOrange), "vest"), figure.around(0.6f, 0.8f, 0.15f);
  if (of(p, "coat") > 0.f) builder.use(cloth(kBlack), "coat"), figure.around(0.3f, 0.82f, 0.2f);
  if (of(p, "pack") > 0.f)
    builder.use(cloth(kGreen), "pack")
        .box({-0.15f * h, -0.08f * h, 0.58f * h}, {-0.05f * h, 0.08f * h, 0.8f * h});
  for (const float side : {-1.f, 1.f}) figure.leg(side), figure.arm(side);
  return figure.builder.build();
}

/// A dummy that stands for a pedestrian, of one fabric, with seams at its joints and perhaps on a plate.
Model puppet(const ShapeParams& p) {
  const Material fabric = cloth(kGrey);
  const float h = of(p, "height"), plate = 0.5f * of(p, "stand");
  Figure figure{{}, h, 0.5f * of(p, "width"), Gait(1.0, 0.0), {fabric, fabric, fabric, fabric, fabric}};
  if (plate > 0.f)
    figure.builder.use(steel(), "stand")
        .rod({0, 0, 0}, {0, 0, 0.01f * h}, plate)
        .rod({-0.05f * h, 0, 0}, {-0.05f * h, 0, 0.6f * h}, 0.012f * h);
  figure.trunk();
  figure.builder.use(matt(kBlack, 0.2f), "seam");
  for (const float z : {0.52f, 0.64f, 0.79f})
    figure.around(z, z + 0.012f, z < 0.6f ? 0.03f : z < 0.7f ? -0.1f : 0.02f);
  for (const float side : {-1.f, 1.f}) figure.leg(side), figure.arm(side);
  return figure.builder.build();
}

}  // namespace

ShapeKinds personShapes() {
  return {
      {"person",
       {"a person who walks at `speed` [m/s], 0: stands; `vest`, `coat`, `helmet` and `pack` 1: wears that, "
        "a part of that name",
        {{"height", 1.75},
         {"width", 0.5},
         {"speed", 0},
         {"vest", 0},
         {"coat", 0},
         {"helmet", 0},
         {"pack", 0}},
        person}},
      {"puppet",
       {"a dummy pedestrian (Fig. 5 of the off-road paper)",
        {{"height", 1.154}, {"width", 0.298}, {"stand", 0}},
        puppet}},
  };
}

}  // namespace field_fusion::core::sim
